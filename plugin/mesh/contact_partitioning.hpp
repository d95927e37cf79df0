#pragma once

#include "synovia/mesh/named_mesh.hpp"

namespace synovia
{

/// Distributes the elements of a serial mesh over ranks so that elements on
/// both sides of a contact come to the same rank where they face each other,
/// and so that each rank has as much of the contact as of the bodies: without
/// that METIS gives each body to a rank of its own, and the contact to one.
/// Names of surfaces that the mesh has not are left out. Gives a rank for each
/// element.
std::vector<int> PartitionByContact(mfem::Mesh &serial,
                                    const NameTable &boundaries,
                                    const std::vector<FacingSurfaces> &contacts,
                                    int ranks);

} // namespace synovia
