#pragma once

#include "synovia/linalg/biphasic_jacobian.hpp"

namespace synovia
{

/// Changes of the multipliers of contact in a Newton step, beside what
/// penalties make of gaps and jumps: for each of the ContactTerms those of this
/// rank's vertices, or nothing where penalties alone close them.
struct MultiplierChanges
{
   /// Area x traction (force).
   std::vector<mfem::Vector> forces;
   /// Area x flux (volume / time).
   std::vector<mfem::Vector> outflows;

   /// There are none, of so many terms.
   void Clear(std::size_t terms)
   {
      forces.assign(terms, mfem::Vector());
      outflows.assign(terms, mfem::Vector());
   }
};

/// The linearized equations with the multipliers of contact as unknowns of
/// their own: A being the Jacobian with the penalties,
///
///     [ A      C ] [ x ]   [  b  ]
///     [ W R  -eI ] [ y ] = [ -W g ]
///
/// for x = (displacement, pressure), with W g the forces that the penalties
/// make of gaps, and dt W_p j the volumes that they make of jumps; y are nodal
/// forces and volumes that the multipliers add to them, and C = (G^T, -J^T).
/// Gaps close as with penalties that are 1 / e times as large, but what
/// preconditions A does so here: with y as W (g + R x) and what A makes of
/// that, eigenvalues are between c / (1 + c) and 1, c being the ratio of
/// penalty and resistance.
///
/// Unknowns and rows are scaled, so that all rows are forces: those of gaps as
/// the penalties over 1 / e make them, about as bodies resist gaps.
class MultiplierSystem : public mfem::Operator
{
public:
   /// Borrows @a jacobian, whose contact may not change in the lifetime of
   /// this. @a pressure_scale: force / volume. @a compliance: e > 0.
   /// Collective.
   MultiplierSystem(const BiphasicJacobian &jacobian,
                    mfem::real_t pressure_scale, mfem::real_t compliance);

   void Mult(const mfem::Vector &x, mfem::Vector &y) const override;
   /// For the residual @a b of the equations with the present multipliers and
   /// penalties.
   mfem::Vector RightSide(const mfem::Vector &b) const;
   /// Applies an approximate inverse of A to scaled rows.
   void Precondition(const mfem::Operator &inverse, const mfem::Vector &rows,
                     mfem::Vector &x) const;
   /// Takes a solution apart.
   void Unpack(const mfem::Vector &solution, mfem::Vector &x,
               MultiplierChanges &changes) const;

private:
   /// Rows of a pair: those of gaps, and then those of jumps.
   struct Block
   {
      const ContactFactors &factors;
      int begin;
      int size;
      mfem::Vector Gaps(mfem::Vector &v) const { return {v, begin, size}; }
      mfem::Vector Jumps(mfem::Vector &v) const
      {
         return {v, begin + size, size};
      }
   };

   static int Rows(const BiphasicJacobian &jacobian);
   /// Multiplies what belongs to pressures, and to multipliers of the flow.
   void Scale(mfem::real_t pressures, mfem::real_t outflows,
              mfem::Vector &v) const;
   /// Multiplies the rows of gaps and jumps.
   void Weigh(mfem::real_t weight, mfem::Vector &rows) const;
   /// y += scale C v
   void AddLoads(mfem::real_t scale, mfem::Vector &v, mfem::Vector &y) const;
   /// Sets the multipliers' rows of @a y.
   void Close(mfem::Vector &v, mfem::Vector &y) const;

   const BiphasicJacobian &jacobian;
   mfem::real_t pressure_scale;
   mfem::real_t compliance;
   std::vector<Block> blocks;
   mutable mfem::Vector unscaled;
};

/// A preconditioner of MultiplierSystem by one of the Jacobian.
class MultiplierPreconditioner : public mfem::Solver
{
public:
   /// Borrows both.
   MultiplierPreconditioner(const MultiplierSystem &system_,
                            const mfem::Operator &inverse_)
      : Solver(system_.Height()), system(system_), inverse(inverse_)
   {
   }
   void SetOperator(const mfem::Operator &) override {}
   void Mult(const mfem::Vector &x, mfem::Vector &y) const override
   {
      system.Precondition(inverse, x, y);
   }

private:
   const MultiplierSystem &system;
   const mfem::Operator &inverse;
};

} // namespace synovia
