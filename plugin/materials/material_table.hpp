#pragma once

#include "synovia/materials/permeability_law.hpp"
#include "synovia/materials/solid_law.hpp"

#include <vector>

namespace synovia
{

/// What a region is made of. The laws are borrowed.
struct Material
{
   const SolidLaw *solid = nullptr;
   const PermeabilityLaw *permeability = nullptr;
   /// phi_s, the volume fraction of the solid; it splits the total stress into
   /// solid and fluid parts and does not enter the balance laws.
   mfem::real_t solid_fraction = 0.2;
   /// Whether the solid sees the mean change of volume of each element instead
   /// of those of its points: nearly incompressible solids don't lock then on
   /// hexahedra and wedges of order 1. Tetrahedra of order 1 stay as they are.
   bool mean_dilatation = false;
};

/// The material of each element attribute.
class MaterialTable
{
public:
   /// Sets the material of the attributes; a second call replaces the first.
   /// Throws Error unless 0 < solid_fraction < 1.
   void Set(const mfem::Array<int> &attributes, const Material &material);

   bool Has(int attribute) const;
   const Material &Get(int attribute) const;

private:
   std::vector<Material> by_attribute;
};

/// kappa of the table's materials.
class PermeabilityCoefficient : public mfem::Coefficient
{
public:
   /// Borrows @a materials.
   explicit PermeabilityCoefficient(const MaterialTable &materials_)
      : materials(materials_)
   {
   }
   mfem::real_t Eval(mfem::ElementTransformation &trans,
                     const mfem::IntegrationPoint &ip) override
   {
      return materials.Get(trans.Attribute)
         .permeability->GetPermeability(trans, ip);
   }

private:
   const MaterialTable &materials;
};

/// 1/H_A of the table's materials.
class ComplianceCoefficient : public mfem::Coefficient
{
public:
   /// Borrows @a materials.
   explicit ComplianceCoefficient(const MaterialTable &materials_)
      : materials(materials_)
   {
   }
   mfem::real_t Eval(mfem::ElementTransformation &trans,
                     const mfem::IntegrationPoint &) override
   {
      return 1.0 / materials.Get(trans.Attribute).solid->AggregateModulus();
   }

private:
   const MaterialTable &materials;
};

} // namespace synovia
