#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/permeability_law.hpp"
#include "synovia/mesh/named_mesh.hpp"
#include "synovia/physics/biphasic_problem.hpp"

#include <memory>
#include <vector>

namespace synovia
{

/// The biphasic problem that a case describes on its mesh, with the laws that
/// it borrows.
class CaseProblem
{
public:
   /// Borrows @a mesh. Collective. Throws Error that lists, with their places,
   /// names that the mesh doesn't have, regions with two materials or none,
   /// materials that make no sense, and bodies that neither displacements nor
   /// contact hold.
   CaseProblem(const CaseFile &setup, NamedMesh &mesh);

   BiphasicProblem &Get() { return problem; }
   const BiphasicProblem &Get() const { return problem; }

private:
   void SetMaterial(const MaterialCase &material);
   /// Makes the law, and those that it is made of.
   const SolidLaw &AddSolid(const SolidCase &solid, LawArguments from);
   void SetBoundary(const BoundaryCase &boundary);
   /// Adds errors for rigid bodies whose ties contradict other conditions, and
   /// for bodies that nothing holds, where there is no contact.
   void CheckRigidBodies(const CaseFile &setup, CaseReading &reading);

   BiphasicProblem problem;
   std::vector<std::unique_ptr<MaterialFrame>> frames;
   std::vector<std::unique_ptr<SolidLaw>> solids;
   std::vector<std::unique_ptr<PermeabilityLaw>> permeabilities;
};

/// Attributes of the boundaries on which displacements or springs resist motion
/// along an axis (0, 1, 2). Throws Error if the mesh doesn't have them.
mfem::Array<int> HeldSurfaces(const CaseFile &setup, const NamedMesh &mesh,
                              int component);

/// Attributes of the boundaries that are tied to a rigid body or to its
/// regions and shape, likewise. Collective.
mfem::Array<int> TiedSurfaces(const RigidBodyCase &body, const NamedMesh &mesh);

/// Attributes of the boundaries in ties, and in contact pairs, likewise.
mfem::Array<int> GluedSurfaces(const CaseFile &setup, const NamedMesh &mesh);
mfem::Array<int> ContactSurfaces(const CaseFile &setup, const NamedMesh &mesh);

} // namespace synovia
