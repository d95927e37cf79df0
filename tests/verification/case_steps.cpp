// ranks: 1 2 3
//
// Steps of a case: what is prescribed changes from one to the next, and the
// state goes on.
//
// 1. Steps that prescribe the parts of one curve give what the curve gives.
// 2. A confined layer that rests under a compression e and is released recovers
//    as one that creeps, for -H_A e is taken off at once: u(h, t) =
//    -e h sum 2 exp(-m^2 c t/h^2)/m^2 over m = (n + 1/2) pi, n >= 0, with
//    c = H_A kappa. It begins where it was held.
// 3. What is held relatively stays where it came to freely, and stays there
//    when other conditions change; so do the freedoms of rigid bodies.
// 4. A run that is resumed in a step goes on as the uninterrupted one.

#include "support/boxes.hpp"
#include "support/temporary_directory.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/io/checkpoint.hpp"
#include "synovia/io/checkpoint_directory.hpp"
#include "synovia/runs/step_sequence.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
std::string Infinitesimal()
{
   return R"([mesh]
file = "box.msh"
[space]
order = 2
[solver]
linear = "direct"
tolerance = 1e-12
[[material]]
regions = "body"
solid = {model = "isotropic", E = 0.5, nu = 0.1}
permeability = {value = 4e-3}
)";
}

std::string Finite()
{
   return R"([mesh]
file = "box.msh"
[space]
order = 2
[physics]
deformation = "finite"
[solver]
linear = "direct"
tolerance = 1e-12
[[material]]
regions = "body"
solid = {model = "neo_hookean", E = 0.5, nu = 0.1}
permeability = {model = "holmes_mow", value = 4e-3, M = 2, alpha = 2}
)";
}

/// Without the top.
std::string Confinement()
{
   return R"([[boundary]]
surfaces = "z0"
displacement = ["free", "free", 0]
[[boundary]]
surfaces = ["x0", "x1"]
displacement = [0, "free", "free"]
[[boundary]]
surfaces = ["y0", "y1"]
displacement = ["free", 0, "free"]
[[boundary]]
surfaces = "z1"
pressure = 0
)";
}

NamedMesh Column()
{
   BoxOptions box;
   box.nx = 2;
   box.nz = 8;
   box.size_x = box.size_y = 0.2;
   box.grading = 1.5;
   return MakeBox(box);
}

struct Row
{
   real_t time = 0.0;
   std::string step;
   /// Mean displacement of the top, and its reaction where it has one.
   real_t top = 0.0;
   real_t reaction = 0.0;
};

real_t ReactionOf(BiphasicProblem &problem, const std::string &surface)
{
   for (const BiphasicProblem::Support &support : problem.Supports())
   {
      if (support.boundary == surface)
      {
         return problem.Reaction(support)[2];
      }
   }
   return 0.0;
}

/// Largest displacement along z, which all of the top has.
real_t TopOf(BiphasicProblem &problem, TimeStepper &stepper)
{
   Array<int> marker(problem.Mesh().Get().bdr_attributes.Max());
   marker = 0;
   for (const int attribute : problem.Mesh().Boundary("z1"))
   {
      marker[attribute - 1] = 1;
   }
   Array<int> dofs;
   problem.Spaces().Displacement().GetEssentialTrueDofs(marker, dofs, 2);
   real_t least = 0.0;
   for (const int dof : dofs)
   {
      least = std::min(least, stepper.State().GetBlock(0)[dof]);
   }
   return -MaxOverRanks(-least, MPI_COMM_WORLD);
}

void March(StepSequence &sequence, std::vector<Row> &rows, real_t until)
{
   while (sequence.Stepper().Time() < until)
   {
      if (sequence.StepIsDone())
      {
         REQUIRE_FALSE(sequence.IsLast());
         sequence.Advance();
      }
      TimeStepper &stepper = sequence.Stepper();
      const StepReport report = stepper.Step();
      CAPTURE(report.reason, report.time);
      REQUIRE(report.converged);
      BiphasicProblem &problem = sequence.Problem().Get();
      rows.push_back({report.time, sequence.Present().name,
                      TopOf(problem, stepper), ReactionOf(problem, "z1")});
   }
}

std::vector<Row> Run(const std::string &text, NamedMesh &mesh)
{
   const CaseFile setup = ParseCase(text, "case.toml");
   StepSequence sequence(setup, mesh);
   std::vector<Row> rows;
   March(sequence, rows, setup.time.end * (1.0 - 1e-12));
   return rows;
}
} // namespace

TEST_CASE("Steps that prescribe the parts of a curve give what the curve gives")
{
   const bool finite = GENERATE(false, true);
   const std::string scheme = GENERATE("backward_euler", "sdirk33");
   CAPTURE(finite, scheme);
   const std::string start =
      (finite ? Finite() : Infinitesimal()) + Confinement();
   NamedMesh mesh = Column();
   const std::vector<Row> whole = Run(start + R"([[boundary]]
surfaces = "z1"
displacement = ["free", "free",
   {times = [0, 100, 300, 350], values = [0, -0.2, -0.2, -0.05]}]
[time]
end = 400
step = 25
scheme = ")" + scheme + "\"\n",
                                      mesh);
   const std::vector<Row> parts = Run(start + R"([[boundary]]
name = "plate"
surfaces = "z1"
displacement = ["free", "free", {times = [0, 100], values = [0, -0.2]}]
[time]
step = 25
scheme = ")" + scheme + R"("
[[step]]
name = "press"
duration = 100
[[step]]
name = "hold"
duration = 200
[[step]]
name = "lift"
duration = 100
[[step.boundary]]
name = "plate"
relative = true
displacement = ["free", "free", {times = [0, 50], values = [0, 0.15]}]
)",
                                      mesh);
   REQUIRE(parts.size() == whole.size());
   REQUIRE(parts.size() == 16);
   CHECK(parts[3].step == "press");
   CHECK(parts[4].step == "hold");
   CHECK(parts[12].step == "lift");
   real_t largest = 0.0;
   for (const Row &row : whole)
   {
      largest = std::max(largest, std::abs(row.reaction));
   }
   CHECK(largest > 1e-3);
   for (size_t i = 0; i < whole.size(); i++)
   {
      CAPTURE(whole[i].time);
      CHECK(parts[i].time == whole[i].time);
      CHECK(std::abs(parts[i].top - whole[i].top) <= 1e-14);
      CHECK(std::abs(parts[i].reaction - whole[i].reaction) <=
            (finite ? 1e-10 : 1e-12) * largest);
   }
}

TEST_CASE("A layer that is released recovers from where it was held")
{
   constexpr real_t compression = 0.01;
   NamedMesh mesh = Column();
   const std::string finite = GENERATE("", "[physics]\n");
   const std::vector<Row> rows =
      Run((finite.empty() ? Infinitesimal() : Finite()) + Confinement() + R"(
[[boundary]]
name = "plate"
surfaces = "z1"
displacement = ["free", "free", {times = [0, 100], values = [0, -0.01]}]
[time]
step = 100
scheme = "sdirk33"
[[step]]
name = "press"
duration = 100
[[step]]
name = "rest"
duration = 1e6
step = 1e5
[[step]]
name = "recover"
duration = 400
step = 10
min_step = 1e-3
release = "plate"
)",
          mesh);
   REQUIRE(rows.size() == 1 + 10 + 40);
   const real_t modulus = 0.5 * 0.9 / (1.1 * 0.8);
   const real_t rate = modulus * 4e-3;
   CHECK(rows[10].reaction ==
         Approx(-modulus * compression * 0.04).epsilon(0.03));
   CHECK(rows[10].top == Approx(-compression).epsilon(1e-10));
   for (size_t i = 11; i < rows.size(); i++)
   {
      const real_t t = rows[i].time - rows[10].time;
      real_t sum = 0.0;
      for (int n = 0; n < 200; n++)
      {
         const real_t m = (n + 0.5) * M_PI;
         sum += 2.0 * std::exp(-m * m * rate * t) / (m * m);
      }
      CAPTURE(t, rows[i].step);
      CHECK(rows[i].reaction == 0.0);
      // In finite deformation, as far as a compression of 1 % is small.
      CHECK(std::abs(rows[i].top + compression * sum) <=
            (finite.empty() ? 1e-2 : 2e-2) * compression);
   }
}

namespace
{
const char *const free_then_held = R"([[boundary]]
name = "weight"
surfaces = "z1"
normal_traction = {times = [0, 50], values = [0, -0.1]}
[time]
step = 10
[[step]]
name = "creep"
duration = 100
[[step]]
name = "hold"
duration = 50
release = "weight"
[[step.boundary]]
name = "plate"
surfaces = "z1"
displacement = ["free", "free", 0]
relative = true
[[step]]
name = "dry"
duration = 50
[[step.boundary]]
name = "suction"
surfaces = "z1"
pressure = {times = [0, 50], values = [0, -0.01]}
)";

std::string WithoutPressure(std::string text)
{
   const std::string drained =
      "[[boundary]]\nsurfaces = \"z1\"\npressure = 0\n";
   const size_t at = text.find(drained);
   REQUIRE(at != std::string::npos);
   return text.replace(at, drained.size(),
                       "[[boundary]]\nname = \"suction\"\nsurfaces = \"z1\"\n"
                       "pressure = 0\n");
}
} // namespace

TEST_CASE("A top that came down freely is held there, and stays")
{
   const bool finite = GENERATE(false, true);
   CAPTURE(finite);
   NamedMesh mesh = Column();
   const std::string text =
      WithoutPressure((finite ? Finite() : Infinitesimal()) + Confinement()) +
      free_then_held;
   const std::vector<Row> rows = Run(text, mesh);
   REQUIRE(rows.size() == 20);
   CHECK(rows[9].top < -0.05);
   CHECK(rows[9].reaction == 0.0);
   for (size_t i = 10; i < rows.size(); i++)
   {
      CAPTURE(rows[i].time);
      CHECK(rows[i].top == rows[9].top);
      CHECK(rows[i].reaction < 0.0);
   }
   // The weight's force at first, less as the fluid flows.
   CHECK(std::abs(rows[10].reaction) < 0.1 * 0.04);
   CHECK(std::abs(rows[14].reaction) < std::abs(rows[10].reaction));

   SECTION("and so it does after a restart in the last step")
   {
      const TemporaryDirectory directory;
      const CaseFile setup = ParseCase(text, "case.toml");
      const real_t at = GENERATE(120.0, 150.0, 170.0);
      {
         StepSequence sequence(setup, mesh);
         std::vector<Row> before;
         March(sequence, before, at);
         WriteCheckpoint(directory.Path(), sequence.Problem().Get(),
                         sequence.Stepper());
      }
      StepSequence sequence(setup, mesh);
      const Checkpoint checkpoint(
         FindCheckpoint(directory.Path(), MPI_COMM_WORLD).file, MPI_COMM_WORLD);
      sequence.GoTo(checkpoint.Time());
      CHECK(sequence.Present().name == (at <= 150.0 ? "hold" : "dry"));
      checkpoint.Restore(sequence.Problem().Get(), sequence.Stepper());
      std::vector<Row> after;
      March(sequence, after, 199.0);
      REQUIRE(after.size() == static_cast<size_t>((200.0 - at) / 10.0));
      for (size_t i = 0; i < after.size(); i++)
      {
         const Row &same = rows[rows.size() - after.size() + i];
         CHECK(after[i].time == same.time);
         CHECK(after[i].top == Approx(same.top).epsilon(1e-12));
         CHECK(after[i].reaction == Approx(same.reaction).epsilon(1e-9));
      }
   }
}

TEST_CASE("A rigid body that turned freely is held as it is")
{
   BoxOptions box;
   box.nz = 3;
   box.size_z = 3.0;
   NamedMesh mesh = MakeBox(box);
   const CaseFile setup = ParseCase(Finite() + R"([[boundary]]
surfaces = "x0"
pressure = 0
[[rigid_body]]
name = "tibia"
surfaces = "z0"
translation = [0, 0, 0]
rotation = [0, 0, 0]
[[rigid_body]]
name = "femur"
surfaces = "z1"
translation = [0, 0, "free"]
rotation = [0, 0, "free"]
moment = [0, 0, {times = [0, 2], values = [0, 0.01]}]
[time]
step = 1
[[step]]
name = "turn"
duration = 3
[[step]]
name = "hold"
duration = 2
[[step.rigid_body]]
name = "femur"
relative = true
translation = [0, 0, {times = [0, 2], values = [0, -0.1]}]
rotation = [0, 0, 0]
)",
                                    "case.toml");
   StepSequence sequence(setup, mesh);
   std::vector<Row> rows;
   March(sequence, rows, 2.5);
   const RigidPose reached =
      sequence.Stepper().Done()
         ? sequence.Problem().Get().RigidBodyStates()[1].pose
         : RigidPose{};
   CHECK(reached[5] > 0.1);
   CHECK(reached[2] != 0.0);
   March(sequence, rows, 4.5);
   const auto now = sequence.Problem().Get().RigidBodyStates()[1];
   CHECK(now.name == "femur");
   CHECK(now.pose[5] == reached[5]);
   CHECK(now.pose[2] == Approx(reached[2] - 0.1).epsilon(1e-14));
   // What holds it has taken over the moment.
   CHECK(now.moment[2] == Approx(0.01).epsilon(0.2));
}

TEST_CASE("Contact that a step releases lets surfaces drain and rise; another "
          "step's pair takes hold")
{
   BoxOptions lower;
   lower.nz = 4;
   lower.size_z = 0.5;
   BoxOptions upper = lower;
   NamedMesh mesh = MakeStack(lower, upper);
   const CaseFile setup = ParseCase(R"([mesh]
file = "box.msh"
[space]
order = 2
[solver]
tolerance = 1e-8
[[material]]
regions = ["lower", "upper"]
solid = {model = "isotropic", E = 0.5, nu = 0.1}
permeability = {value = 4e-3}
[[boundary]]
surfaces = "upper_z1"
displacement = ["free", "free", 0]
pressure = 0
[[boundary]]
name = "plate"
surfaces = "lower_z0"
displacement = ["free", "free", 0]
[[boundary]]
surfaces = ["lower_x0", "lower_x1", "upper_x0", "upper_x1"]
displacement = [0, "free", "free"]
[[boundary]]
surfaces = ["lower_y0", "lower_y1", "upper_y0", "upper_y1"]
displacement = ["free", 0, "free"]
[[contact]]
name = "first"
source = "upper_z0"
destination = "lower_z1"
[time]
step = 50
[[step]]
name = "press"
duration = 100
[[step.boundary]]
name = "plate"
displacement = ["free", "free", {times = [0, 100], values = [0, 0.05]}]
[[step]]
name = "apart"
duration = 1e6
step = 1e5
release = "first"
[[step.boundary]]
name = "plate"
displacement = ["free", "free", {times = [0, 1e5], values = [0.05, 0]}]
[[step.boundary]]
surfaces = ["lower_z1", "upper_z0"]
name = "faces"
pressure = 0
[[step]]
name = "again"
duration = 100
release = "faces"
[[step.contact]]
name = "second"
source = "upper_z0"
destination = "lower_z1"
[[step.boundary]]
name = "plate"
displacement = ["free", "free", {times = [0, 100], values = [0, 0.05]}]
)",
                                    "case.toml");
   StepSequence sequence(setup, mesh);
   const auto force = [&]()
   {
      real_t sum = 0.0;
      for (const auto &support : sequence.Problem().Get().Supports())
      {
         sum += support.boundary == "upper_z1"
                   ? sequence.Problem().Get().Reaction(support)[2]
                   : 0.0;
      }
      return sum;
   };
   const auto march = [&](real_t until)
   {
      while (sequence.Stepper().Time() < until)
      {
         if (sequence.StepIsDone())
         {
            sequence.Advance();
         }
         const StepReport report = sequence.Stepper().Step();
         CAPTURE(report.reason, report.time);
         REQUIRE(report.converged);
      }
   };
   march(100.0);
   const real_t pressed = force();
   CHECK(pressed < -0.01);
   march(1e6);
   CHECK(std::abs(force()) < 1e-10);
   march(1e6 + 200.0);
   CHECK(force() == Approx(pressed).epsilon(1e-3));
}
