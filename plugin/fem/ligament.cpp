#include "synovia/fem/ligament.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

std::string Contradiction(const LigamentOptions &options)
{
   if (options.stiffness < 0.0 || options.strain_stiffness < 0.0)
   {
      return "the stiffness is negative";
   }
   if ((options.stiffness > 0.0) == (options.strain_stiffness > 0.0))
   {
      return "give one of stiffness, a force per length, and "
             "strain_stiffness, a force per strain";
   }
   if (options.slack_length < 0.0)
   {
      return "the slack length is negative";
   }
   if (options.slack_length > 0.0 && options.prestrain != 0.0)
   {
      return "both slack_length and prestrain say how long it is without "
             "force; give one of them";
   }
   if (!(options.prestrain > -1.0))
   {
      return "the strain as meshed must be above -1";
   }
   if (options.toe_strain < 0.0)
   {
      return "the strain where the toe region ends is negative";
   }
   if (options.compression && options.toe_strain > 0.0)
   {
      return "a toe region is one of tension; leave compression or toe_strain "
             "out";
   }
   return "";
}

std::string Contradiction(const Ligament &ligament,
                          const std::vector<std::string> &bodies)
{
   for (const LigamentEnd *end : {&ligament.from, &ligament.to})
   {
      if (!end->body.empty() &&
          std::find(bodies.begin(), bodies.end(), end->body) == bodies.end())
      {
         return "there is no rigid body \"" + end->body +
                "\" that it could be attached to";
      }
   }
   if (ligament.from.body == ligament.to.body)
   {
      return ligament.from.body.empty()
                ? "both ends are points of space; attach one to a rigid body"
                : "both ends are attached to \"" + ligament.from.body +
                     "\", so that its length can't change; attach one to "
                     "another body or to space";
   }
   if (!(ligament.Distance() > 0.0))
   {
      return "both ends are at the same point, so that it has no direction";
   }
   if (!std::isfinite(ligament.Distance()))
   {
      return "its ends are too far apart for numbers";
   }
   return Contradiction(ligament.options);
}

LigamentLaw::LigamentLaw(const Ligament &ligament)
   : slack_length(ligament.options.slack_length > 0.0
                     ? ligament.options.slack_length
                     : ligament.Distance() /
                          (1.0 + ligament.options.prestrain)),
     stiffness(ligament.options.strain_stiffness +
               ligament.options.stiffness * slack_length),
     toe(ligament.options.toe_strain), compression(ligament.options.compression)
{
}

real_t LigamentLaw::Force(real_t length) const
{
   const real_t strain = Strain(length);
   if (strain < 0.0 && !compression)
   {
      return 0.0;
   }
   return IsInToe(strain) ? stiffness * strain * strain / (2.0 * toe)
                          : stiffness * (strain - 0.5 * toe);
}

real_t LigamentLaw::Slope(real_t length) const
{
   const real_t strain = Strain(length);
   if (strain < 0.0 && !compression)
   {
      return 0.0;
   }
   return stiffness / slack_length * (IsInToe(strain) ? strain / toe : 1.0);
}

bool LigamentLaw::Resists(real_t length) const
{
   // One that is just taut holds what would lengthen it.
   constexpr real_t round_off = 1e-12;
   return compression || Strain(length) >= -round_off;
}

} // namespace synovia
