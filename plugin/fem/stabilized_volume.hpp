#pragma once

#include "synovia/fem/smooth_stabilization.hpp"
#include "synovia/fem/strain_monitor.hpp"
#include "synovia/mesh/named_mesh.hpp"

namespace synovia
{

/// How much volume the stabilization of order 1 takes or gives where fluid
/// should: of a pressure p that has grown in proportion, S (p - p_smooth) at a
/// vertex, as part of the undeformed volume around it.
///
/// Where pressures differ within an element by as much as its aggregate
/// modulus, that is as much as the volume itself: bodies lose or gain volume
/// there although nothing has flowed, and no strain means anything. Elements of
/// order 2 have no such term.
class StabilizedVolume
{
public:
   /// Borrows @a mesh and @a spaces, of order 1, and @a stabilization, the
   /// matrix S. Collective.
   StabilizedVolume(const NamedMesh &mesh, BiphasicSpaces &spaces,
                    const MaterialTable &materials,
                    const mfem::HypreParMatrix &stabilization);

   /// The largest part at a pressure (true dofs), with its region and place as
   /// meshed. Collective.
   StrainExtreme FindLargest(const mfem::Vector &p) const;

private:
   std::string RegionAt(int true_dof) const;

   const NamedMesh &mesh;
   BiphasicSpaces &spaces;
   const MaterialTable &materials;
   const mfem::HypreParMatrix &stabilization;
   SmoothStabilization smooth_stabilization;
   /// Of the vertices, as meshed.
   mfem::Vector positions;
   /// Around vertices, of what has fluid.
   mfem::Vector volumes;
};

} // namespace synovia
