#include "synovia/materials/permeability_law.hpp"

namespace synovia
{

mfem::real_t
PermeabilityLaw::GetPermeability(mfem::ElementTransformation &trans,
                                 const mfem::IntegrationPoint &ip) const
{
   Tensor3<> permeability;
   GetReferential({trans, ip}, IdentityTensor(), permeability, nullptr);
   return permeability[0][0];
}

} // namespace synovia
