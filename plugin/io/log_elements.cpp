#include "synovia/fem/body_element.hpp"
#include "synovia/fem/element_permeability.hpp"
#include "synovia/fem/mean_dilatation.hpp"
#include "synovia/io/log_rows.hpp"

#include <algorithm>
#include <set>

namespace synovia
{

using namespace mfem;

namespace
{
/// The elements of this rank that a log asks for.
std::vector<int> FindElements(const LogDefinition &log, NamedMesh &named)
{
   const ParMesh &mesh = named.Get();
   const std::set<long long> wanted(log.numbers.begin(), log.numbers.end());
   std::set<int> attributes;
   for (const std::string &name : log.regions)
   {
      for (const int attribute : named.Region(name))
      {
         attributes.insert(attribute);
      }
   }
   std::vector<int> found;
   for (int e = 0; e < mesh.GetNE(); e++)
   {
      const bool numbered =
         wanted.empty() || wanted.count(named.Numbers().elements[e]) > 0;
      const bool inside =
         attributes.empty() || attributes.count(mesh.GetAttribute(e)) > 0;
      if (numbered && inside)
      {
         found.push_back(e);
      }
   }
   return found;
}

using Symmetric = std::array<real_t, 6>;

Symmetric EntriesOf(const Tensor3<> &tensor)
{
   Symmetric entries;
   for (int k = 0; k < 6; k++)
   {
      const auto &[i, j] = symmetric_entries[k];
      entries[k] = 0.5 * (tensor[i][j] + tensor[j][i]);
   }
   return entries;
}

// Largest first.
Point3 PrincipalValues(const Symmetric &entries)
{
   DenseMatrix matrix(3);
   for (int k = 0; k < 6; k++)
   {
      const auto &[i, j] = symmetric_entries[k];
      matrix(i, j) = matrix(j, i) = entries[k];
   }
   real_t values[3];
   real_t directions[9];
   matrix.CalcEigenvalues(values, directions);
   return {{values[2], values[1], values[0]}};
}

/// What an element has at a point, or on average.
struct ElementValues
{
   Point3 place{};
   Symmetric stress{};
   Symmetric strain{};
   Tensor3<> F{};
   real_t J = 0.0;
   real_t pressure = 0.0;
   Point3 flux{};

   void Add(real_t share, const ElementValues &other)
   {
      for (int d = 0; d < 3; d++)
      {
         place[d] += share * other.place[d];
         flux[d] += share * other.flux[d];
      }
      for (int k = 0; k < 6; k++)
      {
         stress[k] += share * other.stress[k];
         strain[k] += share * other.strain[k];
      }
      F += share * other.F;
      J += share * other.J;
      pressure += share * other.pressure;
   }

   /// In the order of LogData().
   std::vector<real_t> List() const
   {
      std::vector<real_t> list(place.begin(), place.end());
      for (const Symmetric *tensor : {&stress, &strain})
      {
         const Point3 principal = PrincipalValues(*tensor);
         list.insert(list.end(), tensor->begin(), tensor->end());
         list.insert(list.end(), principal.begin(), principal.end());
      }
      for (int k = 0; k < 9; k++)
      {
         list.push_back(F[k / 3][k % 3]);
      }
      list.push_back(J);
      list.push_back(pressure);
      list.insert(list.end(), flux.begin(), flux.end());
      return list;
   }
};

class ElementRows : public LogRows
{
public:
   ElementRows(const LogDefinition &log_, BiphasicProblem &problem_)
      : log(log_), problem(problem_), element(problem.Spaces()),
        permeability(problem.Spaces())
   {
      NamedMesh &mesh = problem.Mesh();
      VerifyLogged(log, mesh.Numbers().elements, mesh.GetComm());
      elements = FindElements(log, mesh);
      finite = problem.GetDeformation() == Deformation::finite;
   }

   std::vector<real_t> Collect(TimeStepper &stepper) override
   {
      acceleration = problem.Acceleration(stepper.Time());
      std::vector<real_t> rows;
      for (const int e : elements)
      {
         element.Set(e, stepper.Displacement(), stepper.Pressure());
         const Material &material =
            problem.Materials().Get(element.Attribute());
         if (!material.IsRigid() && material.mean_dilatation)
         {
            mean_dilatation.Evaluate(element, *material.solid);
         }
         permeability.Set(element);
         ElementValues mean;
         for (int q = 0; q < element.Points(); q++)
         {
            mean.Add(1.0 / element.Points(),
                     AtPoint(material, q, stepper.Displacement()));
         }
         rows.push_back(
            static_cast<real_t>(problem.Mesh().Numbers().elements[e]));
         AddLogged(log, mean.List(), rows);
      }
      return rows;
   }

private:
   ElementValues AtPoint(const Material &material, int q,
                         const ParGridFunction &u)
   {
      ElementValues values;
      values.F = element.DeformationGradient(q);
      const Tensor3<> &F = values.F;
      const MaterialPoint point = element.Point(q);
      const Vector place = element.Position(q);
      Vector moved(3);
      u.GetVectorValue(point.trans, point.ip, moved);
      for (int d = 0; d < 3; d++)
      {
         values.place[d] = place[d] + moved[d];
      }
      const Tensor3<> I = IdentityTensor();
      values.J = finite ? det(F) : Trace(F) - 2.0;
      values.strain =
         EntriesOf(finite ? 0.5 * (TransposedProduct(F, F) - I) : F - I);
      if (material.IsRigid())
      {
         return values;
      }
      values.stress = Effective(material, q, F);
      if (material.HasFluid())
      {
         values.pressure = element.Pressure(q);
         for (int d = 0; d < 3; d++)
         {
            values.stress[d] -= values.pressure;
         }
         values.flux = Flux(material, q, F);
      }
      return values;
   }

   Symmetric Effective(const Material &material, int q, const Tensor3<> &F)
   {
      const MaterialPoint point = element.Point(q);
      if (finite)
      {
         Tensor3<> P;
         if (material.mean_dilatation)
         {
            P = mean_dilatation.Stress(q);
         }
         else
         {
            material.solid->GetStress(point, F, P, nullptr);
         }
         return EntriesOf((1.0 / det(F)) * Product(P, transpose(F)));
      }
      DenseMatrix stiffness;
      material.solid->GetStiffness(point.trans, point.ip, stiffness);
      const Symmetric strain = EntriesOf(F - IdentityTensor());
      Symmetric stress{};
      for (int k = 0; k < 6; k++)
      {
         for (int l = 0; l < 6; l++)
         {
            stress[k] += stiffness(k, l) * (l < 3 ? 1.0 : 2.0) * strain[l];
         }
      }
      return stress;
   }

   Point3 Flux(const Material &material, int q, const Tensor3<> &F)
   {
      const MaterialPoint point = element.Point(q);
      const Tensor3<> turn = finite ? F : IdentityTensor();
      Vector3<> slope = element.PressureGradient(q);
      for (int c = 0; c < 3; c++)
      {
         for (int d = 0; d < 3; d++)
         {
            slope[c] -= material.fluid_density * turn[d][c] * acceleration[d];
         }
      }
      Vector3<> flux;
      if (finite)
      {
         Tensor3<> conductance{};
         permeability.Get(element, *material.permeability, q, conductance);
         flux = (-1.0 / det(F)) * Product(F, Product(conductance, slope));
      }
      else
      {
         flux = -material.permeability->GetPermeability(point.trans, point.ip) *
                slope;
      }
      return {{flux[0], flux[1], flux[2]}};
   }

   const LogDefinition &log;
   BiphasicProblem &problem;
   BodyElement element;
   MeanDilatation mean_dilatation;
   ElementPermeability permeability;
   std::vector<int> elements;
   bool finite = false;
   Point3 acceleration{};
};
} // namespace

std::unique_ptr<LogRows> MakeElementRows(const LogDefinition &log,
                                         BiphasicProblem &problem)
{
   return std::make_unique<ElementRows>(log, problem);
}

} // namespace synovia
