#include "synovia/checks/tie_check.hpp"
#include "synovia/cases/key_names.hpp"
#include "synovia/contact/tied_interface.hpp"
#include "synovia/general/text_table.hpp"
#include "synovia/mesh/named_boundaries.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Sources that cover less may not reach as far as they should.
constexpr real_t covers_all = 0.99;

std::string Percent(real_t part)
{
   return std::to_string(std::lround(100.0 * part)) + " %";
}
} // namespace

std::vector<TieAtStart> CheckTies(const CaseFile &setup, CaseProblem &problem)
{
   const NamedMesh &mesh = problem.Get().Mesh();
   std::vector<TieAtStart> found;
   CaseReading reading(setup.places);
   for (size_t i = 0; i < setup.ties.size(); i++)
   {
      const TieCase &tie = setup.ties[i];
      reading.Catch(
         EntryPath("tie", i),
         [&]()
         {
            TiedInterface interface(tie.Name(), problem.Get().Spaces(),
                                    problem.Get().Materials(),
                                    NamedBoundaries(mesh, tie.source),
                                    NamedBoundaries(mesh, tie.destination),
                                    tie.options, setup.solver.tuning.contact);
            interface.Search(TieHolds());
            found.push_back({tie.Name(), interface.Operators().covered,
                             interface.Operators().distance,
                             interface.Scales().search_radius,
                             interface.Scales().exchanges});
         });
   }
   reading.ThrowIfAny();
   return found;
}

std::vector<std::vector<std::string>>
TieRows(const std::vector<TieAtStart> &ties)
{
   std::vector<std::vector<std::string>> rows;
   for (const TieAtStart &tie : ties)
   {
      if (rows.empty())
      {
         rows.push_back(
            {"", "covered", "largest distance", "search radius", "fluid"});
      }
      rows.push_back({tie.name, Percent(tie.covered), Quantity(tie.distance),
                      Quantity(tie.search_radius),
                      tie.exchanges ? "passes" : "sealed"});
   }
   return rows;
}

std::vector<std::string> FindTieHints(const CaseFile &setup,
                                      const std::vector<TieAtStart> &ties)
{
   std::vector<std::string> hints;
   for (size_t i = 0; i < ties.size(); i++)
   {
      if (ties[i].covered < covers_all)
      {
         hints.push_back(WhereIs(setup.places, EntryPath("tie", i)) +
                         ": the source covers " + Percent(ties[i].covered) +
                         " of the destination of \"" + ties[i].name +
                         "\" only, and the rest of it is free; if all shall be "
                         "tied, give a larger search_radius");
      }
   }
   return hints;
}

} // namespace synovia
