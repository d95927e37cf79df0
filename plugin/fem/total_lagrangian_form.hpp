#pragma once

#include "synovia/fem/body_element.hpp"
#include "synovia/fem/body_form.hpp"
#include "synovia/fem/local_matrix.hpp"
#include "synovia/fem/smooth_stabilization.hpp"
#include "synovia/fem/spring_foundation.hpp"
#include "synovia/mesh/named_mesh.hpp"

#include <memory>
#include <vector>

namespace synovia
{

/// Bodies in finite deformation, integrated over their undeformed shape:
///
///     momentum:  int (P_e(F) - p J F^-T) : grad w
///     mass:      int q (J - J_0) + dt int grad q . K(F) grad p
///                + S (p - p_0 - smooth part)
///
/// with F = I + grad u, the pressure p of the fluid in space, and J_0 what the
/// stage begins with: fluid is conserved to round-off, whatever the step. Its
/// solids must be objective.
class TotalLagrangianForm : public BodyForm
{
public:
   /// Borrows all arguments. Throws Error where a material is none for finite
   /// deformation. Collective.
   TotalLagrangianForm(const NamedMesh &mesh, BiphasicSpaces &spaces,
                       const MaterialTable &materials,
                       const std::vector<SpringFoundation> &springs);

   int ConservedSize() const override { return points; }
   void GetConserved(const mfem::Vector &u,
                     mfem::Vector &conserved) const override;
   void StartStage(const BodyStage &stage, const mfem::Vector &pressure_rate,
                   mfem::real_t rate_dt) override;
   void Mult(const BodyStage &stage, mfem::Vector &momentum,
             mfem::Vector &mass) const override;
   void MultFromStart(const BodyStage &stage, mfem::Vector &momentum,
                      mfem::Vector &mass) const override;
   void GetGrowth(const BodyStage &stage, mfem::Vector &growth) const override;
   void AddMagnitudes(mfem::real_t dt, const mfem::Vector &u,
                      const mfem::Vector &p, mfem::Vector &momentum,
                      mfem::Vector &mass) const override;
   std::string Validate(const BodyStage &stage) const override;
   bool IsLinear() const override { return false; }
   bool Linearize(const BodyStage &stage) override;
   const VolumeMatrices &Tangent() const override { return matrices; }

private:
   /// Sets u and p from true dofs.
   void ToLocal(const mfem::Vector &true_u, const mfem::Vector &true_p) const;
   void AddStabilization(const BodyStage &stage, mfem::Vector &mass) const;
   /// Of the element's point, without reduction.
   std::string ValidatePoint() const;

   const NamedMesh &mesh;
   BiphasicSpaces &spaces;
   const MaterialTable &materials;
   const std::vector<SpringFoundation> &springs;
   VolumeMatrices matrices;
   std::unique_ptr<SmoothStabilization> smooth_stabilization;
   mfem::Vector relief;
   /// Of all elements of this rank.
   int points = 0;
   LocalMatrix stiffness;
   LocalMatrix coupling;
   LocalMatrix flow_change;
   LocalMatrix darcy;
   mutable BodyElement element;
   /// Local dofs.
   mutable mfem::Vector u;
   mutable mfem::Vector p;
};

} // namespace synovia
