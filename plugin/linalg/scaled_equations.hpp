#pragma once

#include "synovia/general/vector_entries.hpp"

namespace synovia
{

/// y = D A D x, D being 1 for displacements and a factor for pressures: makes
/// the residuals of momentum and mass comparable.
class ScaledOperator2x2 : public mfem::Operator
{
public:
   /// Borrows @a inner.
   ScaledOperator2x2(const mfem::Operator &inner_, int pressure_begin_,
                     mfem::real_t factor_)
      : Operator(inner_.Height()), inner(inner_),
        pressure_begin(pressure_begin_), factor(factor_)
   {
   }
   void Mult(const mfem::Vector &x, mfem::Vector &y) const override
   {
      scaled = x;
      ScaleFrom(pressure_begin, factor, scaled);
      inner.Mult(scaled, y);
      ScaleFrom(pressure_begin, factor, y);
   }

private:
   const mfem::Operator &inner;
   int pressure_begin;
   mfem::real_t factor;
   mutable mfem::Vector scaled;
};

/// A preconditioner in scaled unknowns.
class ScaledSolver : public mfem::Solver
{
public:
   /// Borrows @a inner.
   ScaledSolver(const mfem::Operator &inner, int pressure_begin,
                mfem::real_t factor)
      : Solver(inner.Height()), scaled(inner, pressure_begin, factor)
   {
   }
   void SetOperator(const mfem::Operator &) override {}
   void Mult(const mfem::Vector &x, mfem::Vector &y) const override
   {
      scaled.Mult(x, y);
   }

private:
   ScaledOperator2x2 scaled;
};

} // namespace synovia
