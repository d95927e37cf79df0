#pragma once

#include "support/box_case.hpp"
#include "support/gathered_order.hpp"
#include "synovia/io/step_diagnostics.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace synovia
{

/// A box whose top is a rigid body, free in all it does: ligaments hold it, and
/// loads press it for 15 s onto a layer, and then pull it along x and tilt it
/// for 15 s. It slides, sticks, and lifts off in part.
inline const std::string held_box = R"([mesh]
file = "stack.msh"
[space]
order = 1
[physics]
deformation = "finite"
[[material]]
regions = "lower"
solid = {model = "neo_hookean", E = 0.5, nu = 0.1}
permeability = {value = 4e-3}
[[material]]
regions = "upper"
solid = {model = "neo_hookean", E = 5, nu = 0.2}
permeability = {value = 4e-4}
[[boundary]]
surfaces = "lower_z0"
displacement = [0, 0, 0]
[[boundary]]
surfaces = ["lower_x0", "lower_x1"]
pressure = 0
[[rigid_body]]
name = "bone"
surfaces = "upper_z1"
reference = [1.05, 1, 0.9]
force = [{times = [15, 30], values = [0, 0.01]}, 0,
   {times = [0, 15], values = [0, -0.03]}]
moment = [0, {times = [15, 30], values = [0, 0.003]}, 0]
[[ligament]]
name = "front"
from = {point = [2.5, 0.8, 0.9]}
to = {body = "bone", point = [1.45, 0.8, 0.9]}
stiffness = 0.05
compression = true
[[ligament]]
name = "back"
from = {point = [-0.6, 1.3, 0.9]}
to = {body = "bone", point = [0.45, 1.3, 0.9]}
stiffness = 0.2
toe_strain = 0.02
[[ligament]]
name = "side"
from = {point = [0.95, -0.5, 0.9]}
to = {body = "bone", point = [0.95, 0.55, 0.9]}
stiffness = 0.2
compression = true
[[joint]]
name = "joint"
proximal = {origin = [0.95, 1.05, 0.5]}
distal = {body = "bone", origin = [0.95, 1.05, 0.9]}
[[contact]]
name = "gap"
source = "upper_z0"
destination = "lower_z1"
friction = {coefficient = 0.3}
[solver]
linear = "direct"
[time]
end = 30
step = 5
)";

/// A case on the two bodies of the held box, or one in place of it, which
/// begins where it is at first.
class HeldBox
{
public:
   HeldBox(const std::string &text, MPI_Comm comm)
      : setup(ParseCase(text, "case.toml")), mesh(MakeBodies(comm)),
        problem(setup, mesh), stepper(problem.Get(), setup.time)
   {
   }

   BiphasicProblem &Problem() { return problem.Get(); }
   TimeStepper &Stepper() { return stepper; }

   struct Row
   {
      History::Row history;
      /// All dofs in an order that does not depend on the ranks; on rank 0.
      std::vector<double> displacement;
      std::vector<double> pressure;
   };

   /// Goes on until @a until is reached, or to the end.
   std::vector<Row> March(mfem::real_t until)
   {
      BiphasicSpaces &spaces = Problem().Spaces();
      std::vector<Row> rows;
      while (!stepper.Done() && stepper.Time() < until)
      {
         const StepReport report = stepper.Step();
         CAPTURE(report.reason, report.time);
         REQUIRE(report.converged);
         CHECK(report.failures == 0);
         const mfem::BlockVector &state = stepper.State();
         rows.push_back(
            {StepDiagnostics(Problem(), stepper, report),
             GatherInOrder(mesh, spaces.Displacement(), state.GetBlock(0)),
             GatherInOrder(mesh, spaces.Pressure(), state.GetBlock(1))});
      }
      return rows;
   }
   std::vector<Row> March() { return March(setup.time.end); }

private:
   static NamedMesh MakeBodies(MPI_Comm comm)
   {
      BoxOptions layer;
      layer.nx = layer.ny = 5;
      layer.nz = 2;
      layer.size_x = layer.size_y = 2.0;
      layer.size_z = 0.5;
      layer.type = mfem::Element::TETRAHEDRON;
      BoxOptions box;
      box.nx = box.ny = 3;
      box.nz = 1;
      box.size_z = 0.4;
      mfem::Mesh bodies = MakeStackMesh(layer, box);
      for (int i = MakeBoxMesh(layer).GetNV(); i < bodies.GetNV(); i++)
      {
         bodies.GetVertex(i)[0] += 0.45;
         bodies.GetVertex(i)[1] += 0.55;
      }
      return DistributeStack(bodies, comm);
   }

   CaseFile setup;
   NamedMesh mesh;
   CaseProblem problem;
   TimeStepper stepper;
};

/// What is measured together with others: a component by the vector, angles
/// and ways of a joint, and flows of fluid, by the largest of them.
inline std::string KindOf(const std::string &column)
{
   const auto &coordinates = JointCoordinateNames();
   const size_t dot = column.rfind('.');
   const std::string prefix = column.substr(0, dot + 1);
   const std::string name = column.substr(dot + 1);
   const auto place = std::find(coordinates.begin(), coordinates.end(), name);
   if (place != coordinates.end())
   {
      return prefix + (place - coordinates.begin() < 3 ? "angles" : "ways");
   }
   if (name == "fluid_exchange" || name == "growth" || name == "outflow")
   {
      return "flow";
   }
   const size_t last = column.size() - 1;
   const bool is_component =
      last > 0 && column[last] >= 'x' && column[last] <= 'z' &&
      (column[last - 1] == '_' || column[last - 1] == '.');
   return is_component ? column.substr(0, last) : column;
}

/// Whether a column has work, or errors, which are no results.
inline bool IsResult(const std::string &column)
{
   const std::vector<std::string> others = {
      "solver.",     "_error",         "volume_balance",
      "penetration", ".pressure_jump", "displacement_jump"};
   return std::none_of(others.begin(), others.end(),
                       [&](const std::string &part)
                       { return column.find(part) != std::string::npos; });
}

/// Largest magnitude of each kind in a run.
inline std::map<std::string, mfem::real_t>
LargestOf(const std::vector<HeldBox::Row> &rows)
{
   std::map<std::string, mfem::real_t> largest;
   for (const HeldBox::Row &row : rows)
   {
      for (const auto &[column, value] : row.history)
      {
         mfem::real_t &magnitude = largest[KindOf(column)];
         magnitude = std::max(magnitude, std::abs(value));
      }
   }
   return largest;
}

inline mfem::real_t Difference(const std::vector<double> &a,
                               const std::vector<double> &b)
{
   REQUIRE(a.size() == b.size());
   mfem::real_t difference = 0.0;
   for (std::size_t i = 0; i < a.size(); i++)
   {
      difference = std::max(difference, std::abs(a[i] - b[i]));
   }
   return difference;
}

inline mfem::real_t Largest(const std::vector<double> &a)
{
   return Difference(a, std::vector<double>(a.size(), 0.0));
}

/// The last rows of a run are those of a part of it, in parts of the largest
/// of their kind. Fields are compared on ranks that have both.
inline void CheckSame(const std::vector<HeldBox::Row> &part,
                      const std::vector<HeldBox::Row> &whole,
                      mfem::real_t tolerance)
{
   REQUIRE(!part.empty());
   REQUIRE(part.size() <= whole.size());
   const std::map<std::string, mfem::real_t> largest = LargestOf(whole);
   int compared = 0;
   for (std::size_t i = 0; i < part.size(); i++)
   {
      const HeldBox::Row &a = part[i];
      const HeldBox::Row &b = whole[whole.size() - part.size() + i];
      REQUIRE(a.history.size() == b.history.size());
      for (std::size_t k = 0; k < a.history.size(); k++)
      {
         const std::string &column = a.history[k].first;
         CHECK(column == b.history[k].first);
         if (IsResult(column))
         {
            const mfem::real_t scale = largest.at(KindOf(column));
            const mfem::real_t difference =
               std::abs(a.history[k].second - b.history[k].second);
            CAPTURE(i, column, scale, difference / scale);
            CHECK(difference <= tolerance * scale);
            compared++;
         }
      }
      if (!a.pressure.empty() && !b.pressure.empty())
      {
         CAPTURE(i);
         CHECK(Difference(a.displacement, b.displacement) <=
               tolerance * Largest(b.displacement));
         CHECK(Difference(a.pressure, b.pressure) <=
               tolerance * Largest(b.pressure));
      }
   }
   CHECK(compared > 30 * static_cast<int>(part.size()));
}

} // namespace synovia
