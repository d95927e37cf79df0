#pragma once

#include "synovia/fem/strain_monitor.hpp"

#include <string>

namespace synovia
{

/// The largest strains of a run so far, and the warning that they cause.
///
/// Infinitesimal strain is a theory of small strains: beyond 10 %, or where det
/// F falls to 0.5, it no longer describes the material. Finite deformation has
/// no such limits.
class StrainRecord
{
public:
   explicit StrainRecord(Deformation deformation_) : deformation(deformation_)
   {
   }

   /// Takes in an accepted step; gives a warning when these limits are passed
   /// for the first time, else nothing.
   std::string Add(const StrainExtremes &strains, mfem::real_t time);

   /// The largest strains with place and time; empty before the first step.
   std::string Summary() const;

private:
   struct Extreme
   {
      StrainExtreme at;
      mfem::real_t time = 0.0;
   };
   bool BeyondTheory() const;

   Deformation deformation;
   bool empty = true;
   bool warned = false;
   Extreme principal;
   Extreme det_F;
};

} // namespace synovia
