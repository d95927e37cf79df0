#include "synovia/checks/ligament_rows.hpp"
#include "synovia/general/text_table.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
std::string EndText(const LigamentEnd &end)
{
   return end.body.empty() ? "space" : end.body;
}

std::string LawText(const LigamentOptions &options)
{
   return options.compression        ? "spring"
          : options.toe_strain > 0.0 ? "tension, toe region"
                                     : "tension";
}
} // namespace

std::vector<std::vector<std::string>>
LigamentRows(const BoundaryConditions &conditions)
{
   std::vector<std::vector<std::string>> rows;
   for (const Ligament &ligament : conditions.Ligaments())
   {
      if (rows.empty())
      {
         rows.push_back({"", "from", "to", "resists", "length", "slack length",
                         "force", "force per strain"});
      }
      const LigamentLaw law(ligament);
      const real_t length = ligament.Distance();
      rows.push_back({ligament.name, EndText(ligament.from),
                      EndText(ligament.to), LawText(ligament.options),
                      Quantity(length), Quantity(law.SlackLength()),
                      Quantity(law.Force(length)),
                      Quantity(law.StrainStiffness())});
   }
   return rows;
}

} // namespace synovia
