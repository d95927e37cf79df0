#include "synovia/runs/strain_record.hpp"
#include "synovia/general/text.hpp"
#include "synovia/runs/run_texts.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr real_t largest_strain = 0.1;
constexpr real_t smallest_det_F = 0.5;

std::string Described(const StrainExtreme &extreme)
{
   return ToText(extreme.value) + " " + PlaceText(extreme);
}
} // namespace

bool StrainRecord::BeyondTheory() const
{
   return deformation == Deformation::infinitesimal &&
          (std::abs(principal.at.value) > largest_strain ||
           det_F.at.value <= smallest_det_F);
}

std::string StrainRecord::Add(const StrainExtremes &strains, real_t time)
{
   if (empty ||
       std::abs(strains.max_principal.value) > std::abs(principal.at.value))
   {
      principal = {strains.max_principal, time};
   }
   if (empty || strains.min_det_F.value < det_F.at.value)
   {
      det_F = {strains.min_det_F, time};
   }
   empty = false;
   if (warned || !BeyondTheory())
   {
      return "";
   }
   warned = true;
   return "at t = " + ToText(time) + " the largest principal strain is " +
          Described(strains.max_principal) + " and the smallest det F " +
          Described(strains.min_det_F) + ", as meshed: beyond a strain of " +
          ToText(largest_strain) + " or a det F of " + ToText(smallest_det_F) +
          " linear theory is no longer valid there; from now on take forces, "
          "stresses and pressures as estimates, or press less";
}

std::string StrainRecord::Summary() const
{
   if (empty)
   {
      return "";
   }
   const auto when = [](const Extreme &extreme)
   { return Described(extreme.at) + ", t = " + ToText(extreme.time); };
   const bool finite = deformation == Deformation::finite;
   std::string text =
      (finite ? "largest logarithmic strain " : "largest principal strain ") +
      when(principal) + "; smallest det F " + when(det_F);
   if (finite && det_F.at.value <= 0.0)
   {
      text += ": a corner is turned inside out there, although no quadrature "
              "point is; take smaller elements, or better shaped ones";
   }
   else if (det_F.at.value <= 0.0)
   {
      text += ": material is turned inside out there, which linear theory "
              "doesn't know";
   }
   else if (BeyondTheory())
   {
      text += ": beyond linear theory";
   }
   return text;
}

} // namespace synovia
