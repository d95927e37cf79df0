#include "synovia/fem/law_checks.hpp"
#include "synovia/fem/effective_stress_integrator.hpp"
#include "synovia/fem/quadrature_order.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"
#include "synovia/materials/stiffness_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
bool Usable(real_t value)
{
   return value > 0.0 && std::isfinite(value);
}

// Cholesky's factorization, which overwrites the lower half.
bool PositiveDefinite(DenseMatrix &a)
{
   constexpr real_t round_off = 1e-14;
   const int size = a.Height();
   for (int j = 0; j < size; j++)
   {
      real_t pivot = a(j, j);
      const real_t scale = std::abs(pivot);
      for (int k = 0; k < j; k++)
      {
         pivot -= a(j, k) * a(j, k);
      }
      if (!(pivot > round_off * scale))
      {
         return false;
      }
      const real_t root = std::sqrt(pivot);
      a(j, j) = root;
      for (int i = j + 1; i < size; i++)
      {
         real_t sum = a(i, j);
         for (int k = 0; k < j; k++)
         {
            sum -= a(i, k) * a(j, k);
         }
         a(i, j) = sum / root;
      }
   }
   return true;
}

// What is wrong with a stiffness; empty if nothing is.
std::string Fault(const DenseMatrix &stiffness, DenseMatrix &workspace)
{
   if (stiffness.Height() != 6 || stiffness.Width() != 6)
   {
      return "is " + std::to_string(stiffness.Height()) + " x " +
             std::to_string(stiffness.Width()) + "; it must be 6 x 6";
   }
   real_t sum = 0.0;
   real_t skew = 0.0;
   for (int j = 0; j < 6; j++)
   {
      for (int i = 0; i < 6; i++)
      {
         sum += std::abs(stiffness(i, j));
         skew += std::abs(stiffness(i, j) - stiffness(j, i));
      }
   }
   if (!std::isfinite(sum))
   {
      return "has entries that are not finite";
   }
   constexpr real_t round_off = 1e-10;
   if (skew > round_off * sum)
   {
      return "is not symmetric: its entries differ from those of the "
             "transpose by " +
             ToText(skew) + " in all";
   }
   workspace = stiffness;
   if (!PositiveDefinite(workspace))
   {
      const StiffnessRange range = RangeOfStiffness(stiffness);
      return "is not positive definite: its eigenvalues go from " +
             ToText(range.least) + " to " + ToText(range.largest);
   }
   return "";
}

// Whether the undeformed body has the same permeability in all directions.
bool IsIsotropic(const PermeabilityLaw &law, const MaterialPoint &point)
{
   constexpr real_t round_off = 1e-12;
   Tensor3<> K;
   if (!law.GetReferential(point, IdentityTensor(), K, nullptr))
   {
      return false;
   }
   real_t difference = 0.0;
   for (int k = 0; k < 9; k++)
   {
      const bool diagonal = k / 3 == k % 3;
      difference = std::max(
         difference, std::abs(K[k / 3][k % 3] - (diagonal ? K[0][0] : 0.0)));
   }
   return difference <= round_off * K[0][0];
}

// Looks at the laws of one element after the other.
class LawCheck
{
public:
   LawCheck(NamedMesh &mesh_, BiphasicSpaces &spaces_,
            const MaterialTable &materials_, Deformation deformation_)
      : mesh(mesh_), spaces(spaces_), materials(materials_),
        deformation(deformation_)
   {
   }

   /// What is wrong in an element; empty if nothing is.
   std::string Validate(int element)
   {
      mesh.Get().GetElementTransformation(element, &map);
      const Material &material = materials.Get(map.Attribute);
      if (material.IsRigid())
      {
         return "";
      }
      std::string failure = material.solid->Validate(map);
      if (failure.empty() && material.HasFluid())
      {
         failure = material.permeability->Validate(map);
      }
      if (failure.empty())
      {
         failure = StiffnessObjection(*material.solid, element);
      }
      return failure.empty() && material.HasFluid()
                ? PermeabilityObjection(*material.permeability, element)
                : failure;
   }

private:
   std::string StiffnessObjection(const SolidLaw &law, int element)
   {
      const FiniteElement &shapes = *spaces.Displacement().GetFE(element);
      const IntegrationRule &rule =
         EffectiveStressIntegrator::Rule(shapes, map);
      for (int q = 0; q < rule.GetNPoints(); q++)
      {
         const IntegrationPoint &ip = rule.IntPoint(q);
         map.SetIntPoint(&ip);
         law.GetStiffness(map, ip, stiffness);
         const std::string fault = Fault(stiffness, workspace);
         if (!fault.empty())
         {
            return "the stiffness" + Place(element, ip) + " " + fault;
         }
      }
      return "";
   }

   std::string PermeabilityObjection(const PermeabilityLaw &law, int element)
   {
      const FiniteElement &shapes = *spaces.Pressure().GetFE(element);
      const IntegrationRule *const fewer = RuleOfFewerPoints(shapes, map);
      const IntegrationRule &rule =
         fewer ? *fewer : DiffusionIntegrator::GetRule(shapes, shapes);
      for (int q = 0; q < rule.GetNPoints(); q++)
      {
         const IntegrationPoint &ip = rule.IntPoint(q);
         map.SetIntPoint(&ip);
         const real_t value = law.GetPermeability(map, ip);
         if (!Usable(value))
         {
            return "the permeability" + Place(element, ip) + " is " +
                   ToText(value) + "; it must be positive and finite";
         }
         if (deformation == Deformation::infinitesimal &&
             !IsIsotropic(law, {map, ip}))
         {
            return "the permeability" + Place(element, ip) +
                   " differs from one direction to another, which "
                   "infinitesimal deformation doesn't know";
         }
      }
      return "";
   }

   std::string Place(int element, const IntegrationPoint &ip)
   {
      Vector x(3);
      map.Transform(ip, x);
      return " of region \"" + NameOf(mesh.Regions(), map.Attribute) +
             "\" in element " + std::to_string(mesh.SerialElements()[element]) +
             " (counted from 0) at (" + ToText(x(0)) + ", " + ToText(x(1)) +
             ", " + ToText(x(2)) + ")";
   }

   NamedMesh &mesh;
   BiphasicSpaces &spaces;
   const MaterialTable &materials;
   Deformation deformation;
   IsoparametricTransformation map;
   DenseMatrix stiffness;
   DenseMatrix workspace;
};

// ReferenceValue values, the same on all ranks.
void VerifyScales(const NamedMesh &mesh, const MaterialTable &materials)
{
   for (const int attribute : mesh.Get().attributes)
   {
      const Material &material = materials.Get(attribute);
      if (material.IsRigid())
      {
         continue;
      }
      const auto verify = [&](const char *what, real_t value)
      {
         if (!Usable(value))
         {
            throw Error(std::string(what) + " of region \"" +
                        NameOf(mesh.Regions(), attribute) + "\" is " +
                        ToText(value) + "; it must be positive and finite");
         }
      };
      verify("the aggregate modulus", material.solid->AggregateModulus());
      verify("the shear modulus", material.solid->ShearModulus());
      if (material.HasFluid())
      {
         verify("the typical permeability",
                material.permeability->ReferenceValue());
      }
   }
}
} // namespace

void VerifyLaws(NamedMesh &mesh, BiphasicSpaces &spaces,
                const MaterialTable &materials, Deformation deformation)
{
   VerifyScales(mesh, materials);
   LawCheck check(mesh, spaces, materials, deformation);
   std::string message;
   int mine = std::numeric_limits<int>::max();
   for (int i = 0; i < mesh.Get().GetNE(); i++)
   {
      if (mesh.SerialElements()[i] < mine)
      {
         const std::string failure = check.Validate(i);
         if (!failure.empty())
         {
            mine = mesh.SerialElements()[i];
            message = failure;
         }
      }
   }
   int first = mine;
   MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, mesh.GetComm());
   ThrowIfAny(mesh.GetComm(), mine == first ? message : "");
}

} // namespace synovia
