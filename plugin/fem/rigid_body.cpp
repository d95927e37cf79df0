#include "synovia/fem/rigid_body.hpp"

namespace synovia
{

using namespace mfem;

std::string Contradiction(const RigidBodyOptions &options,
                          Deformation deformation)
{
   constexpr const char *axes[3] = {"x", "y", "z"};
   for (int i = 0; i < 6; i++)
   {
      const std::string freedom =
         std::string(i < 3 ? "the translation along " : "the rotation about ") +
         axes[i % 3];
      const std::string load = i < 3 ? "force" : "moment";
      if (options.stiffness[i] < 0.0)
      {
         return "the stiffness of " + freedom + " is negative";
      }
      if (options.IsFree(i))
      {
         continue;
      }
      if (!options.load[i].IsZero())
      {
         return freedom + " is prescribed, and a " + load +
                " acts on it too; give one of them";
      }
      if (options.stiffness[i] > 0.0)
      {
         return freedom + " is prescribed, and a spring holds it too; give "
                          "one of them";
      }
   }
   if (options.load_follows && deformation == Deformation::infinitesimal)
   {
      return "its loads follow it, but in infinitesimal deformation nothing "
             "turns them; take finite deformation, or leave that out";
   }
   return "";
}

} // namespace synovia
