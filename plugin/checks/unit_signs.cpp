#include "synovia/checks/unit_signs.hpp"
#include "synovia/general/text_table.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr real_t anything = std::numeric_limits<real_t>::infinity();

std::string Quotes(const std::string &name)
{
   return '"' + name + '"';
}

void AddApproach(const CaseNumbers &numbers, const UnitFactors &factors,
                 std::vector<UnitSign> &signs)
{
   const LayerApproach *worst = nullptr;
   for (const LayerApproach &load : numbers.loads.approaches)
   {
      if (!worst ||
          load.displacement * worst->depth > worst->displacement * load.depth)
      {
         worst = &load;
      }
   }
   if (worst)
   {
      signs.push_back({worst->displacement * factors.displacements /
                          (worst->depth * factors.lengths),
                       1e-3, 2.0, 0.0, 10.0,
                       "a displacement of " + Quantity(worst->displacement) +
                          " presses " + Quotes(worst->body) +
                          ", which is with what it touches " +
                          Quantity(worst->depth) + " thick"});
   }
}

void AddStress(const CaseNumbers &numbers, const UnitFactors &factors,
               std::vector<UnitSign> &signs)
{
   const real_t softer =
      *std::min_element(factors.stiffness.begin(), factors.stiffness.end());
   UnitSign worst{0.0, 1e-4, 2.0, 0.0, 10.0, ""};
   for (const LayerStress &load : numbers.loads.stresses)
   {
      const real_t area = load.is_force ? std::pow(factors.lengths, 2) : 1.0;
      const real_t strain = load.stress / (load.modulus * softer * area);
      if (strain > worst.value)
      {
         worst.value = strain;
         worst.fact =
            std::string(load.is_force ? "a force over its area"
                                      : "a traction") +
            " of " + Quantity(load.stress) + " presses " + Quotes(load.body) +
            ", and the aggregate modulus there is " + Quantity(load.modulus);
      }
   }
   if (worst.value > 0.0)
   {
      signs.push_back(worst);
   }
}

void AddTimes(const CaseNumbers &numbers, const UnitFactors &factors,
              std::vector<UnitSign> &signs)
{
   real_t longest = 0.0;
   for (size_t i = 0; i < numbers.materials.size(); i++)
   {
      const MaterialNumbers &material = numbers.materials[i];
      if (material.gel_time > 0.0)
      {
         const real_t gel_time =
            material.gel_time * std::pow(factors.lengths, 2) /
            (factors.permeability[i] * factors.stiffness[i]);
         longest = std::max(longest, gel_time);
         signs.push_back(
            {numbers.end / gel_time, 1e-4, anything, 1e-5, anything,
             "the gel time of " + Quotes(material.name) + " is " +
                Quantity(gel_time) + " and the run ends at " +
                Quantity(numbers.end) + ", so that hardly any fluid moves"});
      }
   }
   if (longest > 0.0)
   {
      const bool has_ramps = numbers.load_times.longest > 0.0;
      const real_t duration =
         has_ramps ? numbers.load_times.shortest : numbers.step;
      signs.push_back(
         {duration / longest, 0.0, 1e3, 0.0, 1e4,
          (has_ramps ? "loads take at least " : "a time step takes ") +
             Quantity(duration) + " and the longest gel time is " +
             Quantity(longest) +
             ", so that there is hardly any fluid pressure"});
   }
}

void AddRatios(const CaseNumbers &numbers, const UnitFactors &factors,
               std::vector<UnitSign> &signs)
{
   UnitSign stiffness{0.0, 0.0, 1e5, 0.0, 1e5, ""};
   UnitSign permeability{0.0, 0.0, 1e7, 0.0, 1e9, ""};
   const std::vector<MaterialNumbers> &materials = numbers.materials;
   for (size_t i = 0; i < materials.size(); i++)
   {
      for (size_t j = 0; j < materials.size(); j++)
      {
         const real_t moduli =
            materials[i].aggregate_modulus * factors.stiffness[i] /
            (materials[j].aggregate_modulus * factors.stiffness[j]);
         const bool wet =
            materials[i].permeability > 0.0 && materials[j].permeability > 0.0;
         const real_t permeabilities =
            wet ? materials[i].permeability * factors.permeability[i] /
                     (materials[j].permeability * factors.permeability[j])
                : 0.0;
         // A material that stands for a rigid, draining body is both.
         const real_t rigid = std::max(permeabilities, real_t(1.0));
         if (moduli / rigid > stiffness.value)
         {
            stiffness.value = moduli / rigid;
            stiffness.fact = Quotes(materials[i].name) + " is " +
                             Quantity(moduli) + " times as stiff as " +
                             Quotes(materials[j].name);
         }
         if (permeabilities > permeability.value)
         {
            permeability.value = permeabilities;
            permeability.fact =
               Quotes(materials[i].name) + " is " + Quantity(permeabilities) +
               " times as permeable as " + Quotes(materials[j].name);
         }
      }
   }
   signs.push_back(stiffness);
   signs.push_back(permeability);
}
} // namespace

CaseNumbers FindCaseNumbers(const CaseFile &setup, const NamedMesh &mesh,
                            const std::vector<RegionMeasures> &regions,
                            const LayerLoads &loads)
{
   CaseNumbers numbers;
   numbers.loads = loads;
   numbers.load_times = FindLoadTimes(setup);
   numbers.step = setup.time.step;
   numbers.end = setup.time.end;
   for (const MaterialCase &material : setup.materials)
   {
      MaterialNumbers all;
      for (const std::string &name : material.regions)
      {
         all.name += (all.name.empty() ? "" : "\", \"") + name;
         const Array<int> attributes = mesh.Region(name);
         for (const RegionMeasures &region : regions)
         {
            if (attributes.Find(region.attribute) >= 0)
            {
               all.aggregate_modulus = region.aggregate_modulus;
               all.permeability = region.permeability;
               all.gel_time = std::max(all.gel_time, region.gel_time);
            }
         }
      }
      numbers.materials.push_back(all);
   }
   return numbers;
}

real_t UnitSign::Strangeness() const
{
   if (value < least)
   {
      return std::log10(least / value);
   }
   return value > most ? std::log10(value / most) : 0.0;
}

std::vector<UnitSign> FindUnitSigns(const CaseNumbers &numbers,
                                    const UnitFactors &factors)
{
   std::vector<UnitSign> signs;
   AddApproach(numbers, factors, signs);
   AddStress(numbers, factors, signs);
   AddTimes(numbers, factors, signs);
   AddRatios(numbers, factors, signs);
   return signs;
}

} // namespace synovia
