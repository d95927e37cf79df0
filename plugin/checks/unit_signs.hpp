#pragma once

#include "synovia/checks/layer_loads.hpp"
#include "synovia/checks/load_times.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// A material as units are judged by, of all of its regions.
struct MaterialNumbers
{
   std::string name;
   mfem::real_t aggregate_modulus = 0.0;
   mfem::real_t permeability = 0.0;
   /// The longest; 0 if none of its regions drains.
   mfem::real_t gel_time = 0.0;
};

/// What a case says about its units.
struct CaseNumbers
{
   std::vector<MaterialNumbers> materials;
   LayerLoads loads;
   LoadTimes load_times;
   mfem::real_t step = 0.0;
   mfem::real_t end = 0.0;
};

CaseNumbers FindCaseNumbers(const CaseFile &setup, const NamedMesh &mesh,
                            const std::vector<RegionMeasures> &regions,
                            const LayerLoads &loads);

/// Factors that would put units right.
struct UnitFactors
{
   /// Of the mesh, and of what is prescribed.
   mfem::real_t lengths = 1.0;
   mfem::real_t displacements = 1.0;
   /// By material.
   std::vector<mfem::real_t> permeability;
   std::vector<mfem::real_t> stiffness;

   explicit UnitFactors(size_t materials)
      : permeability(materials, 1.0), stiffness(materials, 1.0)
   {
   }
};

/// A pure number of a case that tells whether its units fit each other.
struct UnitSign
{
   mfem::real_t value;
   /// Where cases have it, and where none does but by mistake.
   mfem::real_t least;
   mfem::real_t most;
   mfem::real_t impossible_below;
   mfem::real_t impossible_above;
   std::string fact;

   /// Decades from what cases have.
   mfem::real_t Strangeness() const;
   bool Impossible() const
   {
      return value < impossible_below || value > impossible_above;
   }
};

/// The signs that a case would have with the factors.
std::vector<UnitSign> FindUnitSigns(const CaseNumbers &numbers,
                                    const UnitFactors &factors);

} // namespace synovia
