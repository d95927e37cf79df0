// ranks: 1 2 3
//
// How penalties and multipliers enforce a constraint, and which vertices touch
// and seal, for gaps and jumps that are given by hand: the same at all
// vertices, whichever rank has them.

#include "synovia/contact/augmented_lagrangian.hpp"
#include "support/boxes.hpp"
#include "synovia/general/reduce.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t area = 0.25;
constexpr real_t face_size = 0.5;
constexpr real_t modulus = 2.0;
constexpr real_t permeability = 1e-3;
constexpr real_t gap_tolerance = 1e-4;
constexpr real_t factor = 100.0;
// What follows from these for a vertex that is covered all around.
constexpr real_t resistance = modulus / face_size;
constexpr real_t penalty = factor * resistance;
constexpr real_t jump_penalty = factor * permeability / face_size;

/// Has the gaps that it is told to have.
class GivenGaps : public ContactConstraint
{
public:
   explicit GivenGaps(int vertices)
   {
      coverage.area.SetSize(vertices);
      coverage.area = area;
      coverage.own_area = coverage.area;
      coverage.face_size.SetSize(vertices);
      coverage.face_size = face_size;
   }

   void SearchReference() override {}
   void SearchAt(const Vector &) override {}
   bool Search(const Vector &) override { return false; }
   void Evaluate(const Vector &, const Vector &, Vector &gap_, Vector &jump_,
                 Vector &pressure) override
   {
      gap_ = gap;
      jump_ = jump;
      pressure = 0.0;
   }
   const ContactCoverage &Coverage() const override { return coverage; }
   ContactFactors Factors() const override { return {}; }
   void Archive(StateArchive &, const std::string &) override {}

   real_t gap = 0.0;
   real_t jump = 0.0;
   ContactCoverage coverage;
};

class Setup
{
public:
   explicit Setup(real_t vertex_area = area)
      : mesh(MakeStack(BoxOptions(), BoxOptions())), spaces(mesh.Get(), 1),
        surface(spaces, mesh.Boundary("lower_z1")),
        constraint(surface.Vertices().Size()),
        vertex_areas(surface.Vertices().Size()),
        enforcement(constraint, surface, Whole(vertex_area), Scales(),
                    ContactOptions())
   {
      REQUIRE(surface.Vertices().GlobalSize() == 4);
      enforcement.UpdatePenalties();
   }

   /// With these gaps and jumps everywhere; says whether the set changed.
   bool Update(real_t gap, real_t jump = 0.0,
               TouchRule rule = TouchRule::traction)
   {
      constraint.gap = gap;
      constraint.jump = jump;
      enforcement.Evaluate(Vector(), Vector());
      return enforcement.UpdateActiveSet(rule);
   }

   /// How many vertices of all ranks touch, and how many seal.
   int Touching() const { return Count(enforcement.State().Touching()); }
   int Sealing() const { return Count(enforcement.State().Sealing()); }

   /// Whether all entries on this rank are @a wanted.
   static bool AllAre(const Vector &values, real_t wanted)
   {
      const real_t tolerance = 1e-12 * std::abs(wanted);
      return std::all_of(values.begin(), values.end(),
                         [&](real_t value)
                         { return std::abs(value - wanted) <= tolerance; });
   }

   const ContactState &State() const { return enforcement.State(); }

   NamedMesh mesh;
   BiphasicSpaces spaces;
   ContactSurface surface;
   GivenGaps constraint;
   Vector vertex_areas;
   AugmentedLagrangian enforcement;

private:
   static int Count(const Vector &ones)
   {
      return static_cast<int>(
         std::lround(SumOverRanks(ones.Sum(), MPI_COMM_WORLD)));
   }
   const Vector &Whole(real_t vertex_area)
   {
      vertex_areas = vertex_area;
      return vertex_areas;
   }
   static ContactScales Scales()
   {
      ContactScales scales;
      scales.softest_modulus = modulus;
      scales.least_permeability = permeability;
      scales.gap_tolerance = gap_tolerance;
      return scales;
   }
};
} // namespace

TEST_CASE("What overlaps presses, and exchanges what a jump drives")
{
   Setup pair;
   CHECK(pair.Update(-1e-3, 0.5));
   CHECK(pair.Touching() == 4);
   CHECK(pair.Sealing() == 4);
   CHECK(Setup::AllAre(pair.State().traction, -1e-3 * penalty));
   CHECK(Setup::AllAre(pair.State().flux, 0.5 * jump_penalty));
   CHECK(Setup::AllAre(pair.State().gap_weights, area * penalty));
   CHECK(Setup::AllAre(pair.State().jump_weights, area * jump_penalty));
   CHECK_FALSE(pair.Update(-2e-3, 0.5));
   CHECK(pair.Update(1e-3, 0.5));
   CHECK(pair.Touching() == 0);
   CHECK(pair.Sealing() == 0);
   CHECK(Setup::AllAre(pair.State().traction, 0.0));
   CHECK(Setup::AllAre(pair.State().flux, 0.0));
}

TEST_CASE("Held pressures exchange nothing")
{
   Setup pair;
   pair.enforcement.SetHeldPressures(pair.surface.Vertices().TrueDofs());
   pair.Update(-1e-3, 0.5);
   CHECK(pair.Sealing() == 4);
   CHECK(Setup::AllAre(pair.State().flux, 0.0));
   CHECK(pair.enforcement.FindViolations().pressure_jump == 0.0);
}

TEST_CASE("A vertex at the rim of the source touches and doesn't seal")
{
   Setup pair(2.0 * area);
   pair.Update(-1e-3);
   CHECK(pair.Touching() == 4);
   CHECK(pair.Sealing() == 0);
}

TEST_CASE("Where nothing is known, what is near touches")
{
   Setup pair;
   SECTION("within the tolerance")
   {
      pair.Update(0.5 * gap_tolerance, 0.0, TouchRule::nearness);
      CHECK(pair.Touching() == 4);
   }
   SECTION("as near as round surfaces that touch at a point")
   {
      pair.Update(0.04 * face_size, 0.0, TouchRule::nearness);
      CHECK(pair.Touching() == 4);
   }
   SECTION("but not farther")
   {
      pair.Update(0.06 * face_size, 0.0, TouchRule::nearness);
      CHECK(pair.Touching() == 0);
   }
   SECTION("nor once the traction decides")
   {
      pair.Update(0.04 * face_size, 0.0, TouchRule::nearness);
      pair.Update(0.5 * gap_tolerance);
      CHECK(pair.Touching() == 0);
   }
}

TEST_CASE("Predicted gaps are weighed by what the bodies resist")
{
   Setup pair;
   constexpr real_t traction = -1e-3 * penalty;
   pair.Update(-1e-3);
   pair.enforcement.Store(1.0);
   pair.enforcement.Store(2.0);
   pair.enforcement.StartStage(3.0);
   CHECK(Setup::AllAre(pair.State().multiplier, traction));
   // Enough to release by the penalty, and not by the resistance.
   constexpr real_t gap = -2.0 * traction / penalty;
   pair.Update(gap);
   CHECK(pair.Touching() == 4);
   pair.Update(gap);
   CHECK(pair.Touching() == 0);
}

TEST_CASE("Multipliers go on along a line, but not beyond reason")
{
   Setup pair;
   pair.enforcement.StartStage(0.0);
   pair.Update(-1e-3);
   pair.enforcement.Store(1.0);
   pair.Update(-1e-3);
   pair.enforcement.Store(2.0);
   // Once and twice the traction so far.
   const real_t last = -2e-3 * penalty;
   REQUIRE(Setup::AllAre(pair.State().multiplier, last));
   SECTION("near")
   {
      pair.enforcement.StartStage(3.0);
      CHECK(Setup::AllAre(pair.State().multiplier, 1.5 * last));
   }
   SECTION("too far")
   {
      pair.enforcement.StartStage(4.0);
      CHECK(Setup::AllAre(pair.State().multiplier, last));
   }
   SECTION("with the past forgotten")
   {
      pair.enforcement.ForgetPast();
      pair.enforcement.StartStage(3.0);
      CHECK(Setup::AllAre(pair.State().multiplier, last));
   }
}

TEST_CASE("An augmentation takes the traction over and releases nothing")
{
   Setup pair;
   pair.Update(-1e-3);
   pair.enforcement.Augment();
   CHECK(Setup::AllAre(pair.State().multiplier, -1e-3 * penalty));
   CHECK_FALSE(pair.Update(2e-3));
   CHECK(pair.Touching() == 4);
   CHECK(pair.Update(2e-3));
   CHECK(pair.Touching() == 0);
}

TEST_CASE("A Newton step takes multipliers to what bears after it")
{
   Setup pair;
   AugmentedLagrangian &enforcement = pair.enforcement;
   pair.Update(-1e-3, 0.5);
   pair.Update(-1e-3, 0.5);
   REQUIRE(pair.Touching() == 4);
   const auto tractions_are = [&](ContactStiffness stiffness, real_t wanted)
   {
      enforcement.UpdateTractions(stiffness);
      return Setup::AllAre(pair.State().traction, wanted);
   };
   CHECK(tractions_are(ContactStiffness::penalty, -1e-3 * penalty));
   CHECK(tractions_are(ContactStiffness::bodies, -1e-3 * resistance));
   CHECK(tractions_are(ContactStiffness::none, 0.0));

   const int own = pair.State().gap.Size();
   Vector gap_change(own);
   Vector jump_change(own);
   gap_change = 0.4e-3;
   jump_change = -0.2;
   const MultiplierStep step =
      enforcement.FindMultiplierStep(gap_change, jump_change);
   CHECK(Setup::AllAre(step.traction, -0.6e-3 * penalty));
   CHECK(Setup::AllAre(step.flux, 0.3 * jump_penalty));
   enforcement.AddToMultipliers(1.0, step);
   enforcement.AddToMultipliers(-0.5, step);
   CHECK(tractions_are(ContactStiffness::none, -0.3e-3 * penalty));
   enforcement.UpdateTractions(ContactStiffness::none);
   CHECK(Setup::AllAre(pair.State().flux, 0.15 * jump_penalty));

   // Open, and as the bodies see it out of contact.
   pair.constraint.gap = 0.4e-3 * factor;
   enforcement.Evaluate(Vector(), Vector());
   enforcement.UpdateActiveSet(TouchRule::traction, ContactStiffness::bodies);
   REQUIRE(pair.Touching() == 0);
   const MultiplierStep release =
      enforcement.FindMultiplierStep(gap_change, jump_change);
   CHECK(Setup::AllAre(release.traction, 0.3e-3 * penalty));
   enforcement.AddToMultipliers(1.0, release);
   CHECK(pair.State().multiplier.Normlinf() <= 1e-15);
}

TEST_CASE("A seal breaks once in a stage")
{
   Setup pair;
   pair.enforcement.StartStage(1.0);
   const auto seals = [&](real_t gap)
   {
      pair.Update(gap);
      return pair.Sealing();
   };
   constexpr real_t open = 2.0 * gap_tolerance;
   constexpr real_t closed = 0.5 * gap_tolerance;
   CHECK(seals(closed) == 4);
   CHECK(seals(open) == 0);
   CHECK(seals(closed) == 4);
   CHECK(seals(open) == 4);
   pair.enforcement.StartStage(2.0);
   CHECK(seals(open) == 0);
}

TEST_CASE("Penalties grow where augmentations are slow, and a failed step "
          "takes that back")
{
   Setup pair;
   AugmentedLagrangian &enforcement = pair.enforcement;
   enforcement.Accept();
   enforcement.StartStage(1.0);
   pair.Update(-1e-3, 0.5);
   constexpr real_t peak = 1.0;
   const ContactViolations violations = enforcement.FindViolations();
   CHECK(violations.penetration == Approx(1e-3));
   CHECK(violations.pressure_jump == Approx(0.5));
   CHECK_FALSE(enforcement.IsWithinTolerance(violations, peak));
   CHECK(enforcement.IsWithinTolerance({gap_tolerance, 1e-3 * peak}, peak));
   CHECK_FALSE(enforcement.StiffenIfSlow(violations, peak));
   // The gap is on its way, the jump isn't.
   const ContactViolations later{2e-4, 0.4};
   CHECK(enforcement.StiffenIfSlow(later, peak));
   CHECK(Setup::AllAre(enforcement.Penalties().Gap(), penalty));
   CHECK(Setup::AllAre(enforcement.Penalties().Jump(), 10.0 * jump_penalty));
   enforcement.Restore();
   CHECK(Setup::AllAre(enforcement.Penalties().Jump(), jump_penalty));
   CHECK(pair.Touching() == 0);
   CHECK(Setup::AllAre(pair.State().traction, 0.0));
   CHECK_FALSE(AnyRank(pair.State().touched, MPI_COMM_WORLD));

   pair.Update(-1e-3);
   enforcement.Accept();
   CHECK(AnyRank(pair.State().touched, MPI_COMM_WORLD));
   pair.Update(1e-3);
   enforcement.Restore();
   CHECK(pair.Touching() == 4);
}
