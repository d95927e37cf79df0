// ranks: 1 2 3
// timeout: 600
//
// Ligaments between rigid bodies. Without tissue that resists, equilibrium is
// one of points: three ligaments of a tripod of the height h + d and the length
// l bear 3 f(l) (h + d)/l; one on a lever of the angle a bears the moment
// f(l) dl/da. Beside a drained block of the stiffness E A / L, without
// Poisson's ratio, a ligament is a spring in parallel.

#include "support/boxes.hpp"
#include "synovia/fem/rotation_vector.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t long_time = 1e8;
constexpr real_t modulus = 0.7;

BoxOptions Block()
{
   BoxOptions box;
   box.nx = 2;
   box.ny = 1;
   box.nz = 2;
   box.size_x = 0.8;
   box.size_y = 0.6;
   box.size_z = 1.5;
   return box;
}

SpaceOptions Space(Deformation deformation)
{
   SpaceOptions space;
   space.order = 1;
   space.deformation = deformation;
   return space;
}

RigidBodyOptions Fixed()
{
   RigidBodyOptions options;
   options.prescribed.fill(LoadCurve(0.0));
   return options;
}

/// Free to go, but not to turn.
RigidBodyOptions Upright()
{
   RigidBodyOptions options = Fixed();
   for (int d = 0; d < 3; d++)
   {
      options.prescribed[d] = std::nullopt;
   }
   return options;
}

/// A block, drained at two sides, that rigid bodies may be tied to.
struct Joined
{
   Joined(Deformation deformation, LinearMethod method)
      : mesh(MakeBox(Block())), problem(mesh, Space(deformation))
   {
      const SolidLaw *solid = &linear;
      if (deformation == Deformation::finite)
      {
         solid = &nonlinear;
      }
      problem.SetMaterial("body", *solid, fluid);
      for (const char *side : {"y0", "y1"})
      {
         problem.PrescribePressure(side, 0.0);
      }
      options.linear.method = method;
      options.linear.relative_tolerance = 1e-10;
   }

   void March(int steps, real_t step)
   {
      problem.SetNonlinearOptions(options);
      TimeOptions times;
      times.step = step;
      times.end = steps * step;
      times.cut_back = false;
      TimeStepper stepper(problem, times);
      while (!stepper.Done())
      {
         const StepReport report = stepper.Step();
         INFO(report.reason);
         REQUIRE(report.converged);
         iterations = std::max(iterations, report.solve.most_linear);
         newton = std::max(newton, report.solve.newton);
      }
   }

   std::string FailureOfStep()
   {
      problem.SetNonlinearOptions(options);
      TimeOptions times;
      times.step = times.end = 1.0;
      times.cut_back = false;
      TimeStepper stepper(problem, times);
      return stepper.Step().reason;
   }

   const IsotropicElastic linear{modulus, 0.0};
   const NeoHookean nonlinear{modulus, 0.2};
   const ConstantPermeability fluid{4e-3};
   NamedMesh mesh;
   BiphasicProblem problem;
   NonlinearOptions options;
   int iterations = 0;
   int newton = 0;
};

Ligament Between(const std::string &name, const LigamentEnd &from,
                 const LigamentEnd &to, real_t stiffness)
{
   Ligament ligament;
   ligament.name = name;
   ligament.from = from;
   ligament.to = to;
   ligament.options.stiffness = stiffness;
   return ligament;
}

/// Where an increasing function is zero.
real_t Root(const std::function<real_t(real_t)> &f, real_t low, real_t high)
{
   REQUIRE(f(low) < 0.0);
   REQUIRE(f(high) > 0.0);
   for (int i = 0; i < 100; i++)
   {
      const real_t middle = 0.5 * (low + high);
      (f(middle) < 0.0 ? low : high) = middle;
   }
   return low;
}

void CheckSame(const Point3 &a, const Point3 &b, real_t tolerance)
{
   CHECK(Length(Sum(a, -1.0, b)) <= tolerance);
}

Point3 Times(real_t s, const Point3 &a)
{
   return Sum({{0.0, 0.0, 0.0}}, s, a);
}
} // namespace

TEST_CASE("A body hangs from three ligaments as deep as their law says")
{
   const Deformation deformation =
      GENERATE(Deformation::infinitesimal, Deformation::finite);
   const LinearMethod method =
      GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   const real_t toe = GENERATE(0.0, 0.08, 10.0);
   CAPTURE(static_cast<int>(deformation), static_cast<int>(method), toe);
   const bool finite = deformation == Deformation::finite;
   const real_t height = 0.8;
   const real_t radius = 0.5;
   const real_t per_strain = 0.3;
   const real_t weight = 0.15;
   Joined hung(deformation, method);
   RigidBodyOptions seat = Upright();
   seat.load[2] = Ramp(4.0, -weight);
   hung.problem.AddRigidBody("seat", {"z1"}, seat);
   const Point3 center{{0.4, 0.3, 1.5}};
   for (int i = 0; i < 3; i++)
   {
      const real_t angle = 0.3 + 2.0 * M_PI / 3.0 * i;
      const Point3 above{
         {radius * std::cos(angle), radius * std::sin(angle), height}};
      Ligament ligament;
      ligament.name = "ligament " + std::to_string(i);
      ligament.from = {"", Sum(center, 1.0, above)};
      ligament.to = {"seat", center};
      ligament.options.strain_stiffness = per_strain;
      ligament.options.toe_strain = toe;
      ligament.options.prestrain = 0.05;
      hung.problem.AddLigament(ligament);
   }
   hung.March(4, 1.0);

   const real_t meshed = std::hypot(height, radius);
   const auto length = [&](real_t depth)
   {
      return finite ? std::hypot(height + depth, radius)
                    : meshed + depth * height / meshed;
   };
   const auto force = [&](real_t depth)
   {
      const real_t strain = 1.05 * length(depth) / meshed - 1.0;
      return strain < toe ? per_strain * strain * strain / (2.0 * toe)
                          : per_strain * (strain - 0.5 * toe);
   };
   const auto missing = [&](real_t depth)
   {
      const real_t upward =
         finite ? (height + depth) / length(depth) : height / meshed;
      return 3.0 * force(depth) * upward - weight;
   };
   const real_t depth = Root(missing, -0.03, 3.0);
   CHECK(depth > 0.1);
   const RigidPose pose = hung.problem.RigidBodyStates().front().pose;
   CHECK(pose[2] == Approx(-depth).epsilon(1e-8));
   CHECK(std::abs(pose[0]) + std::abs(pose[1]) < 1e-9);
   for (const auto &ligament : hung.problem.LigamentStates())
   {
      CHECK(ligament.length == Approx(length(depth)).epsilon(1e-8));
      CHECK(ligament.force == Approx(force(depth)).epsilon(1e-8));
   }
   CHECK(hung.iterations <= 40);
   CHECK(hung.newton <= 10);
}

TEST_CASE("A ligament holds a lever that turned far")
{
   const LinearMethod method =
      GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   CAPTURE(static_cast<int>(method));
   const real_t stiffness = 0.05;
   const real_t slack = 0.8;
   const real_t moment = 0.04;
   Joined lever(Deformation::finite, method);
   RigidBodyOptions turning = Fixed();
   turning.reference = Point3{{0.3, 0.2, 1.5}};
   turning.prescribed[5] = std::nullopt;
   turning.load[5] = Ramp(8.0, moment);
   lever.problem.AddRigidBody("lever", {"z1"}, turning);
   Ligament ligament = Between("ligament", {"", {{2.3, 0.2, 1.5}}},
                               {"lever", {{1.3, 0.2, 1.5}}}, stiffness);
   ligament.options.slack_length = slack;
   lever.problem.AddLigament(ligament);
   lever.March(8, 1.0);

   // The arm is 1, the post is 2 from the axis.
   const auto length = [](real_t angle)
   { return std::sqrt(5.0 - 4.0 * std::cos(angle)); };
   const auto missing = [&](real_t angle)
   {
      return stiffness * (length(angle) - slack) * 2.0 * std::sin(angle) /
                length(angle) -
             moment;
   };
   const real_t angle = Root(missing, 0.0, 1.2);
   CHECK(angle > 0.7);
   CHECK(lever.problem.RigidBodyStates().front().pose[5] ==
         Approx(angle).epsilon(1e-8));
   CHECK(lever.problem.LigamentStates().front().length ==
         Approx(length(angle)).epsilon(1e-8));
   CHECK(lever.newton <= 7);
}

TEST_CASE("A ligament beside a block bears its share once it is taut")
{
   const LinearMethod method =
      GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   // The other end's springs: none, it is fixed.
   const real_t base_stiffness = GENERATE(0.0, 0.5);
   const real_t slack = GENERATE(0.0, 0.02, 0.2);
   const real_t force = GENERATE(0.02, -0.02);
   const bool spring = GENERATE(false, true);
   CAPTURE(static_cast<int>(method), base_stiffness, slack, force, spring);
   Joined joined(Deformation::infinitesimal, method);
   const BoxOptions box = Block();
   const real_t of_block = modulus * box.size_x * box.size_y / box.size_z;
   const real_t stiffness = 0.3;
   RigidBodyOptions base = Fixed();
   if (base_stiffness > 0.0)
   {
      base = RigidBodyOptions();
      base.stiffness.fill(base_stiffness);
   }
   RigidBodyOptions end;
   end.load[2] = force;
   joined.problem.AddRigidBody("base", {"z0"}, base);
   joined.problem.AddRigidBody("end", {"z1"}, end);
   Ligament ligament = Between("ligament", {"base", {{0.4, 0.3, 0.0}}},
                               {"end", {{0.4, 0.3, 1.5}}}, stiffness);
   ligament.options.slack_length = box.size_z + slack;
   ligament.options.compression = spring;
   joined.problem.AddLigament(ligament);
   joined.March(1, long_time);

   const auto of_ligament = [&](real_t opening)
   {
      const real_t beyond = opening - slack;
      return beyond > 0.0 || spring ? stiffness * beyond : 0.0;
   };
   const real_t opening =
      Root([&](real_t d) { return of_block * d + of_ligament(d) - force; },
           -1.0, 1.0);
   const real_t given = base_stiffness > 0.0 ? force / base_stiffness : 0.0;
   const auto states = joined.problem.RigidBodyStates();
   CHECK(states[0].pose[2] == Approx(given).epsilon(1e-7).margin(1e-12));
   CHECK(states[1].pose[2] - states[0].pose[2] ==
         Approx(opening).epsilon(1e-7));
   const auto now = joined.problem.LigamentStates().front();
   CHECK(now.length == Approx(box.size_z + opening).epsilon(1e-8));
   CHECK(now.force == Approx(of_ligament(opening)).margin(1e-9));
   CHECK(states[1].force[2] == Approx(force - now.force).epsilon(1e-8));
   CHECK(joined.iterations <= 40);
}

namespace
{
/// Two bodies that nothing but ligaments holds, with the block between them.
struct Hammock
{
   explicit Hammock(LinearMethod method) : both(Deformation::finite, method)
   {
      RigidBodyOptions lower;
      RigidBodyOptions upper;
      upper.reference = Point3{{0.5, 0.2, 1.7}};
      for (int i = 0; i < 6; i++)
      {
         upper.load[i] = Ramp(6.0, loads[i]);
      }
      both.problem.AddRigidBody("lower", {"z0"}, lower);
      both.problem.AddRigidBody("upper", {"z1"}, upper);
      const real_t corners[4][2] = {
         {-0.2, -0.1}, {1.0, -0.2}, {1.1, 0.8}, {-0.1, 0.7}};
      for (int i = 0; i < 4; i++)
      {
         const real_t x = corners[i][0];
         const real_t y = corners[i][1];
         Add({"", {{2.0 * x - 0.3, 2.0 * y, -1.0}}}, {"lower", {{x, y, 0.1}}},
             0.1);
         Add({"", {{1.5 * x, 1.5 * y - 0.2, 2.8}}}, {"upper", {{x, y, 1.4}}},
             0.06);
         Add({"lower", {{x, y, 0.1}}}, {"upper", {{y, x, 1.4}}}, 0.03);
      }
   }

   void Add(const LigamentEnd &from, const LigamentEnd &to, real_t stiffness)
   {
      const std::string name = std::to_string(ligaments.size());
      ligaments.push_back(Between(name, from, to, stiffness));
      ligaments.back().options.prestrain = 0.4;
      ligaments.back().options.toe_strain = ligaments.size() % 2 ? 0.1 : 0.0;
      both.problem.AddLigament(ligaments.back());
   }

   const RigidPose loads{{0.01, -0.015, -0.02, 0.01, 0.008, -0.012}};
   Joined both;
   std::vector<Ligament> ligaments;
};
} // namespace

TEST_CASE("Forces and moments of ligaments balance loads and each other")
{
   const LinearMethod method =
      GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   CAPTURE(static_cast<int>(method));
   Hammock hammock(method);
   Joined &both = hammock.both;
   both.March(6, 10.0);
   const auto states = both.problem.RigidBodyStates();
   CHECK(Length(RotationOf(states[1].pose)) > 0.1);
   const auto now = both.problem.LigamentStates();
   REQUIRE(now.size() == hammock.ligaments.size());
   const Point3 references[2] = {{{0.4, 0.3, 0.0}}, {{0.5, 0.2, 1.7}}};
   Point3 forces[2] = {{{0.0, 0.0, 0.0}}, TranslationOf(hammock.loads)};
   Point3 moments[2] = {{{0.0, 0.0, 0.0}}, RotationOf(hammock.loads)};
   real_t most = 0.0;
   for (std::size_t i = 0; i < now.size(); i++)
   {
      const LigamentEnd *ends[2] = {&hammock.ligaments[i].from,
                                    &hammock.ligaments[i].to};
      Point3 places[2];
      Point3 arms[2];
      int bodies[2];
      for (int e = 0; e < 2; e++)
      {
         bodies[e] = ends[e]->body.empty()      ? -1
                     : ends[e]->body == "upper" ? 1
                                                : 0;
         places[e] = ends[e]->point;
         if (bodies[e] >= 0)
         {
            const RigidPose &pose = states[bodies[e]].pose;
            arms[e] = Times(RotationMatrix(RotationOf(pose)),
                            Sum(ends[e]->point, -1.0, references[bodies[e]]));
            places[e] =
               Sum(Sum(references[bodies[e]], 1.0, TranslationOf(pose)), 1.0,
                   arms[e]);
         }
      }
      const Point3 along = Sum(places[1], -1.0, places[0]);
      CHECK(now[i].length == Approx(Length(along)).epsilon(1e-10));
      CHECK(now[i].force ==
            Approx(LigamentLaw(hammock.ligaments[i]).Force(Length(along)))
               .epsilon(1e-10));
      most = std::max(most, now[i].force);
      for (int e = 0; e < 2; e++)
      {
         if (bodies[e] >= 0)
         {
            const Point3 pull = Times(
               (e == 0 ? 1.0 : -1.0) * now[i].force / Length(along), along);
            forces[bodies[e]] = Sum(forces[bodies[e]], 1.0, pull);
            moments[bodies[e]] =
               Sum(moments[bodies[e]], 1.0, Cross(arms[e], pull));
         }
      }
   }
   for (int b = 0; b < 2; b++)
   {
      CheckSame(states[b].force, forces[b], 1e-8 * most);
      CheckSame(states[b].moment, moments[b], 1e-8 * most);
   }
   CheckSame(states[0].force, Times(-1.0, states[1].force), 1e-8 * most);
   CHECK(both.iterations <= 40);
   CHECK(both.newton <= 7);
}

TEST_CASE("Newton's method with ligaments converges quadratically")
{
   // Ten decades more take three iterations more at most.
   const auto iterations = [](real_t tolerance)
   {
      Hammock hammock(LinearMethod::direct);
      hammock.both.options.linear.relative_tolerance = tolerance;
      hammock.both.options.active_set_tolerance = 0.0;
      hammock.both.March(6, 10.0);
      return hammock.both.newton;
   };
   const int coarse = iterations(1e-2);
   const int fine = iterations(1e-12);
   CAPTURE(coarse, fine);
   CHECK(fine <= coarse + 3);
}

TEST_CASE("Ligaments turn with their bodies without getting longer")
{
   Joined pair(Deformation::finite, LinearMethod::direct);
   RigidBodyOptions driven = Fixed();
   driven.reference = Point3{{0.1, -0.4, 0.2}};
   const Point3 axis{{2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0}};
   for (int d = 0; d < 3; d++)
   {
      driven.prescribed[d + 3] = Ramp(8.0, 0.5 * M_PI * axis[d]);
   }
   pair.problem.AddRigidBody("driven", {"z0"}, driven);
   pair.problem.AddRigidBody("follower", {"z1"}, RigidBodyOptions());
   Ligament spring = Between("spring", {"driven", {{1.0, 0.5, 0.0}}},
                             {"follower", {{-0.3, 0.2, 1.5}}}, 0.5);
   spring.options.compression = true;
   pair.problem.AddLigament(spring);
   pair.March(8, 1.0);
   const auto now = pair.problem.LigamentStates().front();
   CHECK(now.length == Approx(spring.Distance()).epsilon(1e-10));
   CHECK(std::abs(now.force) < 1e-10);
   CheckSame(RotationOf(pair.problem.RigidBodyStates()[1].pose),
             Times(0.5 * M_PI, axis), 1e-9);
}

TEST_CASE("A body that ligaments don't hold is an error that says so")
{
   Joined hung(Deformation::infinitesimal, LinearMethod::direct);
   RigidBodyOptions seat = Upright();
   SECTION("one that goes sideways")
   {
      hung.problem.AddRigidBody("seat", {"z1"}, seat);
      hung.problem.AddLigament(Between("rope", {"", {{0.4, 0.3, 3.0}}},
                                       {"seat", {{0.4, 0.3, 1.5}}}, 1.0));
      CHECK_THAT(hung.FailureOfStep(),
                 Catch::Contains("nothing holds \"body\", free to move along"));
   }
   SECTION("one that goes towards the other end")
   {
      seat.prescribed[0] = seat.prescribed[1] = 0.0;
      seat.load[2] = 0.1;
      hung.problem.AddRigidBody("seat", {"z1"}, seat);
      Ligament rope = Between("rope", {"", {{0.4, 0.3, 3.0}}},
                              {"seat", {{0.4, 0.3, 1.5}}}, 1.0);
      hung.problem.AddLigament(rope);
      CHECK_THROWS_WITH(hung.FailureOfStep(),
                        Catch::Contains("nothing resists the force"));
   }
   SECTION("one that is slack")
   {
      seat.prescribed[0] = seat.prescribed[1] = 0.0;
      seat.load[2] = -0.1;
      hung.problem.AddRigidBody("seat", {"z1"}, seat);
      Ligament rope = Between("rope", {"", {{0.4, 0.3, 3.0}}},
                              {"seat", {{0.4, 0.3, 1.5}}}, 1.0);
      rope.options.prestrain = -0.1;
      hung.problem.AddLigament(rope);
      CHECK_THAT(hung.FailureOfStep(),
                 Catch::Contains("nothing holds \"body\", free to move along "
                                 "z") &&
                    Catch::Contains("nor does a slack ligament"));
   }
}

TEST_CASE("What contradicts itself about ligaments is an error")
{
   Joined hung(Deformation::finite, LinearMethod::direct);
   hung.problem.AddRigidBody("seat", {"z1"}, Upright());
   const Ligament good = Between("rope", {"", {{0.4, 0.3, 3.0}}},
                                 {"seat", {{0.4, 0.3, 1.5}}}, 1.0);
   const auto check =
      [&](const std::function<void(Ligament &)> &change, const char *text)
   {
      Ligament wrong = good;
      change(wrong);
      CHECK_THROWS_WITH(hung.problem.AddLigament(wrong),
                        Catch::Contains("the ligament \"rope\": ") &&
                           Catch::Contains(text));
   };
   check([](Ligament &rope) { rope.to.body = "chair"; },
         "there is no rigid body \"chair\"");
   check([](Ligament &rope) { rope.from.body = "seat"; },
         "both ends are attached to \"seat\"");
   check([](Ligament &rope) { rope.to.body = ""; },
         "both ends are points of space");
   check([](Ligament &rope) { rope.to.point = rope.from.point; },
         "at the same point");
   check([](Ligament &rope) { rope.options.stiffness = -1.0; },
         "the stiffness is negative");
   check([](Ligament &rope) { rope.options.stiffness = 0.0; },
         "give one of stiffness");
   check([](Ligament &rope) { rope.options.strain_stiffness = 2.0; },
         "give one of stiffness");
   check([](Ligament &rope) { rope.options.slack_length = -2.0; },
         "the slack length is negative");
   check([](Ligament &rope) { rope.options.prestrain = -1.0; },
         "must be above -1");
   check([](Ligament &rope) { rope.options.toe_strain = -0.1; }, "is negative");
   check(
      [](Ligament &rope)
      {
         rope.options.slack_length = 2.0;
         rope.options.prestrain = 0.1;
      },
      "give one of them");
   check(
      [](Ligament &rope)
      {
         rope.options.compression = true;
         rope.options.toe_strain = 0.1;
      },
      "a toe region is one of tension");
   CHECK_NOTHROW(hung.problem.AddLigament(good));
}
