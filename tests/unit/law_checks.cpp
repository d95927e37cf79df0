// ranks: 1 2 3
//
// Laws that fail in one element only are refused on all ranks alike, with
// region, element, place and value, before anything is assembled.

#include "support/two_boxes.hpp"
#include "synovia/general/error.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <functional>
#include <limits>
#include <string>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t not_finite = std::numeric_limits<real_t>::infinity();
const real_t not_a_number = std::numeric_limits<real_t>::quiet_NaN();

// One cell of the upper box.
bool InTheOne(ElementTransformation &trans, const IntegrationPoint &ip)
{
   Vector x(3);
   trans.Transform(ip, x);
   return x(0) > 2.0 / 3.0 && x(1) < 1.0 / 3.0 && x(2) > 5.0 / 3.0;
}

/// How a complaint about it goes on, on any number of ranks.
std::string PlaceOfTheOne()
{
   NamedMesh mesh = MakeTwoBoxes(Element::HEXAHEDRON);
   int number = -1;
   for (int i = 0; i < mesh.Get().GetNE(); i++)
   {
      ElementTransformation &trans = *mesh.Get().GetElementTransformation(i);
      if (InTheOne(trans, Geometries.GetCenter(trans.GetGeometryType())))
      {
         number = mesh.SerialElements()[i];
      }
   }
   MPI_Allreduce(MPI_IN_PLACE, &number, 1, MPI_INT, MPI_MAX, mesh.GetComm());
   REQUIRE(number >= 0);
   return " of region \"upper\" in element " + std::to_string(number) +
          " (counted from 0) at (";
}

/// A stiffness that something happens to in one element.
class PatchySolid : public LinearSolid
{
public:
   using Change = std::function<void(DenseMatrix &)>;
   explicit PatchySolid(Change change_) : change(std::move(change_)) {}

   void GetStiffness(ElementTransformation &trans, const IntegrationPoint &ip,
                     DenseMatrix &stiffness) const override
   {
      solid.GetStiffness(trans, ip, stiffness);
      if (InTheOne(trans, ip))
      {
         change(stiffness);
      }
   }
   real_t AggregateModulus() const override { return aggregate; }
   real_t ShearModulus() const override { return solid.ShearModulus(); }

   real_t aggregate = 1.0;

private:
   IsotropicElastic solid{0.5, 0.1};
   Change change;
};

/// A permeability that has another value in one element.
class PatchyPermeability : public IsotropicPermeability<PatchyPermeability>
{
public:
   explicit PatchyPermeability(real_t value_) : value(value_) {}
   template <typename T>
   bool Spatial(const MaterialPoint &point, const T &, T &k) const
   {
      k = InTheOne(point.trans, point.ip) ? value : 1e-3;
      return true;
   }
   real_t ReferenceValue() const override { return typical; }

   real_t typical = 1e-3;

private:
   real_t value;
};

/// What the problem says of its laws before it is assembled; empty if nothing.
std::string CaseError(const SolidLaw &solid,
                      const PermeabilityLaw &permeability, int order,
                      Element::Type type = Element::HEXAHEDRON)
{
   NamedMesh mesh = MakeTwoBoxes(type);
   SpaceOptions space;
   space.order = order;
   BiphasicProblem problem(mesh, space);
   const IsotropicElastic sound(0.5, 0.1);
   const ConstantPermeability constant(1e-3);
   problem.SetMaterial("lower", sound, constant);
   problem.SetMaterial("upper", solid, permeability);
   problem.FixDisplacement("lower_top");
   problem.FixDisplacement("upper_bottom");
   try
   {
      problem.Operator();
   }
   catch (const Error &error)
   {
      return error.what();
   }
   return "";
}

const PatchySolid::Change nothing = [](DenseMatrix &) {};
} // namespace

TEST_CASE("Laws that hold everywhere are taken", "[laws]")
{
   const auto type =
      GENERATE(Element::HEXAHEDRON, Element::TETRAHEDRON, Element::WEDGE);
   CHECK(CaseError(PatchySolid(nothing), PatchyPermeability(1e-9),
                   GENERATE(1, 2), type) == "");
   // Nearly incompressible, and nearly rigid in one direction
   const auto stiffen = [](DenseMatrix &c)
   {
      IsoparametricTransformation trans;
      IsotropicElastic(1.0, 0.4999999).GetStiffness(trans, {}, c);
      c(2, 2) *= 1e6;
   };
   CHECK(CaseError(PatchySolid(stiffen), PatchyPermeability(1e-3), 1) == "");
}

TEST_CASE("A permeability must be positive and finite", "[laws]")
{
   const real_t value = GENERATE(-3e-3, 0.0, not_finite, not_a_number);
   const int order = GENERATE(1, 2);
   const std::string text =
      CaseError(PatchySolid(nothing), PatchyPermeability(value), order);
   CAPTURE(text);
   CHECK_THAT(text, Catch::StartsWith("the permeability" + PlaceOfTheOne()));
   const std::string number = value != value        ? "nan"
                              : value == not_finite ? "inf"
                              : value == 0.0        ? "0"
                                                    : "-0.003";
   CHECK_THAT(text, Catch::EndsWith(" is " + number +
                                    "; it must be positive and finite"));
}

TEST_CASE("A stiffness must be finite, symmetric and positive definite",
          "[laws]")
{
   const auto complaint = [](const PatchySolid::Change &change)
   { return CaseError(PatchySolid(change), PatchyPermeability(1e-3), 1); };
   const std::string start = "the stiffness" + PlaceOfTheOne();

   std::string text = complaint([](DenseMatrix &c) { c(4, 4) = -0.25; });
   CHECK_THAT(text, Catch::StartsWith(start) &&
                       Catch::Contains("is not positive definite: its "
                                       "eigenvalues go from -0.5 to "));
   // Positive on the diagonal all the same
   text = complaint([](DenseMatrix &c) { c(0, 1) = c(1, 0) = 2.0; });
   CHECK_THAT(text, Catch::StartsWith(start) &&
                       Catch::Contains("is not positive definite: its "
                                       "eigenvalues go from -1."));
   text = complaint([](DenseMatrix &c) { c(1, 5) = not_a_number; });
   CHECK_THAT(text, Catch::StartsWith(start) &&
                       Catch::EndsWith("has entries that are not finite"));
   text = complaint([](DenseMatrix &c) { c(0, 3) = 0.01; });
   CHECK_THAT(text,
              Catch::StartsWith(start) && Catch::Contains("is not symmetric"));
   text = complaint([](DenseMatrix &c) { c.SetSize(3); });
   CHECK_THAT(text, Catch::StartsWith(start) &&
                       Catch::EndsWith("is 3 x 3; it must be 6 x 6"));
}

TEST_CASE("The scales that laws give must be positive", "[laws]")
{
   PatchySolid solid(nothing);
   PatchyPermeability permeability(1e-3);
   solid.aggregate = -2.0;
   CHECK(CaseError(solid, permeability, 1) ==
         "the aggregate modulus of region \"upper\" is -2; it must be positive "
         "and finite");
   solid.aggregate = 1.0;
   permeability.typical = not_a_number;
   CHECK_THAT(
      CaseError(solid, permeability, 1),
      Catch::StartsWith("the typical permeability of region \"upper\" is nan"));
}

TEST_CASE("Infinitesimal deformation takes isotropic permeabilities", "[laws]")
{
   const CartesianFrame frame(Point3{{1.0, 0.0, 0.0}});
   const PoreGrowth growth{1.0, 1.0, 0.2};
   const PatchySolid solid(nothing);
   const ReferentialIsotropicPermeability same(1e-3, 2e-3, 3e-3, growth);
   CHECK(CaseError(solid, same, 1) == "");
   const ReferentialTransverselyIsotropicPermeability along(
      {1e-3, 0.0, 1e-3, 0.0, 0.0}, growth, growth, growth, frame);
   CHECK_THAT(CaseError(solid, along, 1),
              Catch::StartsWith("the permeability of region \"upper\" in "
                                "element ") &&
                 Catch::Contains("differs from one direction to another"));
}
