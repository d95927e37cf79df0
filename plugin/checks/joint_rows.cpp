#include "synovia/checks/joint_rows.hpp"

namespace synovia
{

namespace
{
std::string SideText(const JointSide &side)
{
   return side.body.empty() ? "space" : side.body;
}
} // namespace

std::vector<std::vector<std::string>>
JointRows(const BoundaryConditions &conditions)
{
   std::vector<std::vector<std::string>> rows;
   for (const Joint &joint : conditions.Joints())
   {
      if (rows.empty())
      {
         rows.push_back({"", "side", "proximal", "distal", "prescribed"});
      }
      std::string prescribed;
      for (int k = 0; k < 6; k++)
      {
         if (joint.prescribed[k])
         {
            prescribed +=
               (prescribed.empty() ? "" : ", ") + JointCoordinateNames()[k];
         }
      }
      rows.push_back({joint.name, joint.of == JointOf::right ? "right" : "left",
                      SideText(joint.proximal), SideText(joint.distal),
                      prescribed.empty() ? "-" : prescribed});
   }
   return rows;
}

} // namespace synovia
