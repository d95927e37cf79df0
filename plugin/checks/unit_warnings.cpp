#include "synovia/checks/unit_warnings.hpp"
#include "synovia/checks/unit_signs.hpp"
#include "synovia/general/text_table.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
// Suspicions must leave less than this part of what is strange, in decades.
constexpr real_t explains = 0.5;
// Suspicions that leave the same but for this are a tie, whatever the
// round-off.
constexpr real_t tie = 1e-6;

/// A quantity that may be in another unit than the rest.
struct Suspicion
{
   UnitFactors factors;
   /// Key of the case, what it says, and in which way that is wrong.
   std::string path;
   std::string what;
   std::string looks;
   std::string remedy;
   /// Whether it is about all materials.
   bool of_all = false;
};

real_t Strangeness(const std::vector<UnitSign> &signs)
{
   real_t sum = 0.0;
   for (const UnitSign &sign : signs)
   {
      sum += sign.Strangeness();
   }
   return sum;
}

std::string Looks(real_t factor)
{
   return factor > 1.0 ? Quantity(factor) + " times too small"
                       : Quantity(1.0 / factor) + " times too large";
}

/// All that may be wrong, single materials before all of them together.
class Suspicions
{
public:
   Suspicions(const CaseFile &setup_, const CaseNumbers &numbers_)
      : setup(setup_), numbers(numbers_)
   {
      for (const real_t factor : {1e3, 1e-3})
      {
         AddLengths(factor);
         AddDisplacements(factor);
      }
      for (const real_t factor : {1e12, 1e-12})
      {
         AddMaterials({"permeability.value", "permeability", "permeabilities",
                       "from m^4/(N s) to mm^4/(N s) it is a factor of 1e12",
                       &UnitFactors::permeability},
                      factor);
      }
      for (const real_t factor : {1e6, 1e-6})
      {
         AddMaterials({"solid", "stiffness", "stiffnesses",
                       "from Pa to MPa it is a factor of 1e-6",
                       &UnitFactors::stiffness},
                      factor);
      }
   }

   const std::vector<Suspicion> &List() const { return list; }

private:
   size_t Materials() const { return numbers.materials.size(); }

   void AddLengths(real_t factor)
   {
      Suspicion lengths{UnitFactors(Materials()), "mesh.file", "the mesh looks",
                        Looks(factor), ""};
      lengths.factors.lengths = factor;
      lengths.remedy =
         std::string("if it is in ") +
         (factor > 1.0 ? "meters and the case in millimeters"
                       : "millimeters and the case in meters") +
         ", set mesh.scale = " + Quantity(setup.mesh.options.scale * factor);
      list.push_back(lengths);
   }

   void AddDisplacements(real_t factor)
   {
      const std::vector<LayerApproach> &approaches = numbers.loads.approaches;
      if (approaches.empty())
      {
         return;
      }
      const auto largest =
         std::max_element(approaches.begin(), approaches.end(),
                          [](const LayerApproach &a, const LayerApproach &b)
                          { return a.displacement < b.displacement; });
      Suspicion moves{UnitFactors(Materials()),
                      "boundary." + std::to_string(largest->boundary) +
                         ".displacement",
                      "the displacement looks", Looks(factor), ""};
      moves.factors.displacements = factor;
      moves.remedy = "give it in the unit of the mesh, in which its layers are "
                     "as thick as that";
      list.push_back(moves);
   }

   // A property that all materials have, in words.
   struct Property
   {
      std::string key;
      std::string singular;
      std::string plural;
      std::string remedy;
      std::vector<real_t> UnitFactors::*factors;
   };

   void AddMaterials(const Property &property, real_t factor)
   {
      for (size_t i = 0; i < Materials() && Materials() > 1; i++)
      {
         Suspicion one{UnitFactors(Materials()), Path(i, property.key),
                       "the " + property.singular + " of \"" +
                          numbers.materials[i].name + "\" looks",
                       Looks(factor), property.remedy};
         (one.factors.*property.factors)[i] = factor;
         list.push_back(one);
      }
      Suspicion all{UnitFactors(Materials()), Path(0, property.key),
                    Materials() > 1 ? "all " + property.plural + " look"
                                    : "the " + property.singular + " looks",
                    Looks(factor), property.remedy};
      all.of_all = true;
      (all.factors.*property.factors).assign(Materials(), factor);
      list.push_back(all);
   }

   static std::string Path(size_t material, const std::string &key)
   {
      return "material." + std::to_string(material) + "." + key;
   }

   const CaseFile &setup;
   const CaseNumbers &numbers;
   std::vector<Suspicion> list;
};

// If the same of all materials explains as much as that of one.
std::string OrAll(const std::vector<Suspicion> &suspicions,
                  const Suspicion &likely, const CaseNumbers &numbers,
                  real_t least)
{
   for (const Suspicion &other : suspicions)
   {
      const bool is_alike = other.of_all && !likely.of_all &&
                            other.looks == likely.looks &&
                            other.remedy == likely.remedy;
      if (is_alike &&
          Strangeness(FindUnitSigns(numbers, other.factors)) < least + tie)
      {
         return " (or " + other.what + " so)";
      }
   }
   return "";
}

// The impossible facts, or else the strangest one.
std::string FactsOf(std::vector<UnitSign> signs)
{
   constexpr size_t most = 2;
   std::stable_sort(signs.begin(), signs.end(),
                    [](const UnitSign &a, const UnitSign &b)
                    {
                       return a.Impossible() != b.Impossible()
                                 ? a.Impossible()
                                 : a.Strangeness() > b.Strangeness();
                    });
   std::string facts;
   for (size_t i = 0; i < std::min(most, signs.size()); i++)
   {
      if (signs[i].Strangeness() > 0.0)
      {
         facts += (facts.empty() ? "" : ", and ") + signs[i].fact;
      }
   }
   return facts;
}
} // namespace

std::vector<std::string>
FindUnitWarnings(const CaseFile &setup, CaseProblem &problem,
                 const std::vector<PairAtStart> &pairs,
                 const std::vector<Body> &bodies,
                 const std::vector<RegionMeasures> &regions)
{
   const CaseNumbers numbers =
      FindCaseNumbers(setup, problem.Get().Mesh(), regions,
                      FindLayerLoads(setup, problem, pairs, bodies, regions));
   const std::vector<UnitSign> signs =
      FindUnitSigns(numbers, UnitFactors(numbers.materials.size()));
   if (std::none_of(signs.begin(), signs.end(),
                    [](const UnitSign &sign) { return sign.Impossible(); }))
   {
      return {};
   }
   const Suspicions suspicions(setup, numbers);
   const Suspicion *likely = nullptr;
   real_t least = explains * Strangeness(signs);
   for (const Suspicion &suspicion : suspicions.List())
   {
      const real_t left =
         Strangeness(FindUnitSigns(numbers, suspicion.factors));
      if (left < least - tie)
      {
         least = left;
         likely = &suspicion;
      }
   }
   if (!likely)
   {
      return {"units don't fit each other: " + FactsOf(signs) +
              "; check those of lengths, permeabilities, stiffnesses and "
              "times"};
   }
   return {WhereIs(setup.places, likely->path) + ": " + likely->what + " " +
           likely->looks + OrAll(suspicions.List(), *likely, numbers, least) +
           ": " + FactsOf(signs) + "; " + likely->remedy};
}

} // namespace synovia
