#include "synovia/checks/rigid_body_rows.hpp"
#include "synovia/checks/layer_loads.hpp"
#include "synovia/fem/tied_nodes.hpp"
#include "synovia/general/text.hpp"

namespace synovia
{

namespace
{
std::string FreedomText(const RigidBodyOptions &options, int freedom)
{
   if (!options.IsFree(freedom))
   {
      return Amplitude(*options.prescribed[freedom]) > 0.0 ? "prescribed"
                                                           : "fixed";
   }
   std::string text;
   if (Amplitude(options.load[freedom]) > 0.0)
   {
      text = freedom < 3 ? "force" : "moment";
   }
   if (options.stiffness[freedom] > 0.0)
   {
      text += text.empty() ? "spring" : " and spring";
   }
   return text.empty() ? "free" : text;
}

std::string FreedomsText(const RigidBodyOptions &options, int first)
{
   return FreedomText(options, first) + ", " + FreedomText(options, first + 1) +
          ", " + FreedomText(options, first + 2);
}
} // namespace

std::vector<std::vector<std::string>>
RigidBodyRows(const BoundaryConditions &conditions, BiphasicSpaces &spaces)
{
   std::vector<std::vector<std::string>> rows;
   for (const RigidBody &body : conditions.RigidBodies())
   {
      if (rows.empty())
      {
         rows.push_back(
            {"", "reference point", "translation x, y, z", "rotation x, y, z"});
      }
      const Point3 reference = TiedNodes(spaces, body).Reference();
      rows.push_back({body.name,
                      "(" + ToText(reference[0]) + ", " + ToText(reference[1]) +
                         ", " + ToText(reference[2]) + ")",
                      FreedomsText(body.options, 0),
                      FreedomsText(body.options, 3)});
   }
   return rows;
}

} // namespace synovia
