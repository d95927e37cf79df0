#pragma once

#include "synovia/materials/fluid_supply.hpp"
#include "synovia/materials/permeability_law.hpp"
#include "synovia/materials/solid_law.hpp"

#include <optional>
#include <vector>

namespace synovia
{

/// What a region is made of. The laws are borrowed.
struct Material
{
   /// Null: part of a rigid body.
   const SolidLaw *solid = nullptr;
   /// Null: an elastic solid without fluid.
   const PermeabilityLaw *permeability = nullptr;
   /// phi_s, the volume fraction of the solid; it splits the total stress into
   /// solid and fluid parts and does not enter the balance laws. Pores are
   /// closed where the volume ratio is this small.
   mfem::real_t solid_fraction = 0.2;
   /// Whether the solid sees the mean change of volume of each element instead
   /// of its points' own: nearly incompressible solids don't lock then on
   /// hexahedra and wedges of order 1. Tetrahedra of order 1 stay as they are.
   bool mean_dilatation = false;
   /// True ones of solid and fluid, for forces per mass (mass / volume).
   mfem::real_t solid_density = 0.0;
   mfem::real_t fluid_density = 0.0;
   /// Without effect where there is no fluid.
   FluidSupply supply{};

   bool IsRigid() const { return solid == nullptr; }
   bool HasFluid() const { return permeability != nullptr; }
   bool HasSupply() const { return HasFluid() && supply.Any(); }
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
   /// Of these attributes, those whose materials have fluid; all of them must
   /// have a material.
   mfem::Array<int> WithFluid(const mfem::Array<int> &attributes) const;
   /// Whether fluid is supplied anywhere.
   bool HasSupply() const;

private:
   std::vector<std::optional<Material>> by_attribute;
};

/// kappa of the table's materials; 0 without fluid.
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
      const Material &material = materials.Get(trans.Attribute);
      return material.HasFluid()
                ? material.permeability->GetPermeability(trans, ip)
                : 0.0;
   }

private:
   const MaterialTable &materials;
};

/// A number of the table's supplies of fluid; 0 where there is none.
class SupplyCoefficient : public mfem::Coefficient
{
public:
   using Number = mfem::real_t (*)(const FluidSupply &);

   /// Borrows @a materials.
   SupplyCoefficient(const MaterialTable &materials_, Number number_)
      : materials(materials_), number(number_)
   {
   }
   mfem::real_t Eval(mfem::ElementTransformation &trans,
                     const mfem::IntegrationPoint &) override
   {
      const Material &material = materials.Get(trans.Attribute);
      return material.HasSupply() ? number(material.supply) : 0.0;
   }

private:
   const MaterialTable &materials;
   Number number;
};

/// 1/H_A of the table's materials; 0 without fluid.
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
      const Material &material = materials.Get(trans.Attribute);
      return material.HasFluid() ? 1.0 / material.solid->AggregateModulus()
                                 : 0.0;
   }

private:
   const MaterialTable &materials;
};

} // namespace synovia
