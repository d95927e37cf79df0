#pragma once

#include "mfem.hpp"

#include <algorithm>

namespace synovia
{

/// Coulomb's law on the share of the load that the solids bear (Zimmerman &
/// Ateshian, J Biomech Eng 144(6):061006, 2022): fluid that bears a load does
/// not rub.
///
///     mu_eff = mu_eq [1 - (1 - phi) p/|t_n|],   not below 0,
///
/// with the traction t_n, the pressure p of the fluid and the fraction phi of
/// the contact area where solid meets solid. Tangential tractions have at most
/// the limit mu_eff |t_n|, which needs no quotient: at the edge of a contact
/// p/|t_n| is 0/0.
class FrictionLaw
{
public:
   /// @param coefficient      mu_eq, that without fluid pressure; 0: none
   /// @param solid_fraction   phi
   FrictionLaw(mfem::real_t coefficient, mfem::real_t solid_fraction)
      : mu(coefficient), fluid_share(1.0 - solid_fraction)
   {
   }

   /// Largest tangential traction (stress) under a normal traction (negative in
   /// compression) and a pressure of the fluid.
   mfem::real_t Limit(mfem::real_t traction, mfem::real_t pressure) const
   {
      const mfem::real_t on_solid = -traction - fluid_share * pressure;
      return traction < 0.0 ? mu * std::max<mfem::real_t>(0.0, on_solid) : 0.0;
   }
   /// Derivatives of the limit by traction and pressure, where it is not zero.
   mfem::real_t ByTraction() const { return -mu; }
   mfem::real_t ByPressure() const { return -mu * fluid_share; }

   /// mu_eff; 0 without compression.
   mfem::real_t Effective(mfem::real_t traction, mfem::real_t pressure) const
   {
      return traction < 0.0 ? Limit(traction, pressure) / -traction : 0.0;
   }

private:
   mfem::real_t mu;
   mfem::real_t fluid_share;
};

} // namespace synovia
