#pragma once

#include "synovia/mesh/curved_layers.hpp"

namespace synovia
{

/// Size of MakeCurvedLayers() and of a problem on the layers, before either is
/// made; it may be too large to be computed.
struct LayersEstimate
{
   /// Elements before they are split; rank 0 holds tetrahedra whole for a
   /// while.
   mfem::real_t unsplit_elements = 0.0;
   /// Displacements of the order asked for, and pressures.
   mfem::real_t unknowns = 0.0;
   /// Least memory of all ranks together: the mesh, and tetrahedra before they
   /// are distributed, and the elements' matrices once.
   mfem::real_t gigabytes = 0.0;
};

/// @param order    of the displacement, at least 1
LayersEstimate EstimateLayers(const LayersOptions &options, int order);

/// Collective. Throws Error if there are more elements or unknowns than can be
/// numbered, or if the machines of all ranks lack the memory; says how many
/// there would be.
void VerifySize(const LayersEstimate &estimate, MPI_Comm comm);

} // namespace synovia
