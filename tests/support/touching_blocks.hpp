#pragma once

#include "synovia/synovia.hpp"

#include <array>
#include <memory>

namespace synovia
{

struct TouchingBlocksOptions
{
   Deformation deformation = Deformation::infinitesimal;
   SearchConfiguration configuration = SearchConfiguration::reference;
   int order = 2;
   /// With curved elements and a curved interface.
   bool curved = false;
   FrictionOptions friction;
   ContactTuning tuning;
};

/// Two blocks of meshes that do not match, the upper one tilted onto the lower
/// one: partly in contact and partly apart, partly sealed and partly drained.
/// The upper one's rim covers some faces in part: in contact, but not sealed.
class TouchingBlocks
{
public:
   explicit TouchingBlocks(const TouchingBlocksOptions &options);

   /// The upper block overlaps the lower one for x < 0.5 and lifts off beyond;
   /// it lies further by @a slide along x. True dofs.
   mfem::Vector Displacement(mfem::real_t slide);
   /// Decides on the contact of a searched pair at a state, with multipliers
   /// that are not zero.
   void Touch(const mfem::Vector &u, const mfem::Vector &p);

   /// Vertices over all ranks: in contact, sealed, and seeing the source at
   /// all.
   std::array<int, 3> Counts() const;
   /// Vertices over all ranks that slide, and that stick; none without
   /// friction.
   std::array<int, 2> Sliding() const;

   NamedMesh mesh;
   mutable BiphasicSpaces spaces;
   MaterialTable materials;
   std::unique_ptr<ContactPair> pair;

private:
   IsotropicElastic lower_linear;
   IsotropicElastic upper_linear;
   NeoHookean lower_solid;
   NeoHookean upper_solid;
   ConstantPermeability lower_fluid;
   ConstantPermeability upper_fluid;
};

/// Entries between -1 and 1, others on each rank and for each seed.
mfem::Vector RandomEntries(int size, int seed);

/// Over all ranks.
mfem::real_t NormOf(const mfem::Vector &x);

} // namespace synovia
