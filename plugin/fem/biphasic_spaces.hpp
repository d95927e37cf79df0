#pragma once

#include "mfem.hpp"

#include <memory>

namespace synovia
{

/// The finite element spaces of a biphasic problem on one mesh.
///
/// Order k >= 2 is Taylor-Hood: displacement (and velocity) of order k,
/// pressure of order k - 1, both continuous. Order 1 is equal order and needs
/// the pressure stabilization, which may be weakened. The contact multipliers
/// live on the vertices, so that a face has only a handful of constraints and
/// quadratic surfaces don't lock.
class BiphasicSpaces
{
public:
   /// Borrows @a mesh, which must have no hanging nodes. @a order must be at
   /// least 1; @a stabilization, from 0 to 1, scales the stabilization of order
   /// 1. Throws Error.
   BiphasicSpaces(mfem::ParMesh &mesh, int order,
                  mfem::real_t stabilization = 1.0);

   int Order() const { return order; }
   bool Stabilized() const { return order == 1 && stabilization > 0.0; }
   mfem::real_t Stabilization() const { return stabilization; }

   /// Three components, ordered by node as BoomerAMG wants.
   mfem::ParFiniteElementSpace &Displacement() { return *displacement; }
   mfem::ParFiniteElementSpace &Pressure() { return *pressure; }
   /// Scalar, order 1: one degree of freedom a vertex. The pressure space
   /// itself where that has order 1.
   mfem::ParFiniteElementSpace &Multiplier() { return *multiplier; }

   /// Multiplier true dofs of the vertices among pressure true dofs, sorted.
   mfem::Array<int> VerticesAmong(const mfem::Array<int> &pressure_dofs) const;

   /// Offsets of the true dofs of displacement and pressure in a block vector.
   const mfem::Array<int> &Offsets() const { return offsets; }
   mfem::ParMesh &GetMesh() { return *displacement->GetParMesh(); }
   MPI_Comm GetComm() const { return displacement->GetComm(); }

private:
   int order;
   mfem::real_t stabilization;
   mfem::H1_FECollection displacement_elements;
   mfem::H1_FECollection pressure_elements;
   mfem::H1_FECollection multiplier_elements;
   std::unique_ptr<mfem::ParFiniteElementSpace> displacement;
   std::unique_ptr<mfem::ParFiniteElementSpace> pressure;
   std::unique_ptr<mfem::ParFiniteElementSpace> own_multiplier;
   mfem::ParFiniteElementSpace *multiplier;
   mfem::Array<int> offsets;
};

} // namespace synovia
