#include "synovia/io/step_diagnostics.hpp"
#include "synovia/contact/contact_diagnostics.hpp"
#include "synovia/contact/tie_diagnostics.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr const char *axes[3] = {"x", "y", "z"};

void AddPoint(History::Row &row, const std::string &name, const Point3 &value)
{
   for (int d = 0; d < 3; d++)
   {
      row.emplace_back(name + axes[d], value[d]);
   }
}

// Springs of one name, in several directions, count together.
void AddSprings(History::Row &row, BiphasicProblem &problem,
                const Vector &displacement)
{
   std::vector<std::pair<std::string, Point3>> forces;
   for (size_t i = 0; i < problem.SpringNames().size(); i++)
   {
      const std::string &name = problem.SpringNames()[i];
      const Point3 force =
         problem.Conditions().Springs()[i].Force(displacement);
      const auto same =
         std::find_if(forces.begin(), forces.end(),
                      [&](const auto &entry) { return entry.first == name; });
      if (same == forces.end())
      {
         forces.emplace_back(name, force);
      }
      else
      {
         same->second = Sum(same->second, 1.0, force);
      }
   }
   for (const auto &[name, force] : forces)
   {
      AddPoint(row, "spring." + name + ".", force);
   }
}

void AddContact(History::Row &row, const ContactPair &pair)
{
   const std::string prefix = "contact." + pair.Name() + ".";
   const ContactDiagnostics now = Diagnose(pair);
   const Point3 sum = Sum(now.source_force, 1.0, now.destination_force);
   AddPoint(row, prefix + "force_", now.destination_force);
   AddPoint(row, prefix + "source_force_", now.source_force);
   row.emplace_back(prefix + "force_error", Length(sum));
   const Point3 moment = Sum(now.source_moment, 1.0, now.destination_moment);
   AddPoint(row, prefix + "moment_", now.destination_moment);
   row.emplace_back(prefix + "moment_error", Length(moment));
   row.emplace_back(prefix + "fluid_load_support", now.fluid_load_support);
   row.emplace_back(prefix + "area", now.area);
   row.emplace_back(prefix + "penetration", now.penetration);
   row.emplace_back(prefix + "pressure_jump", now.pressure_jump);
   row.emplace_back(prefix + "peak_traction", now.peak_traction);
   row.emplace_back(prefix + "peak_pressure", now.peak_pressure);
   row.emplace_back(prefix + "fluid_exchange", now.fluid_exchange);
   if (pair.State().rubs)
   {
      AddPoint(row, prefix + "friction_", now.friction.force);
      row.emplace_back(prefix + "friction_coefficient",
                       now.friction.coefficient);
      row.emplace_back(prefix + "sliding", now.friction.sliding);
      row.emplace_back(prefix + "dissipation", now.friction.dissipation);
   }
}

void AddTie(History::Row &row, const TiedInterface &tie, const Vector &moved)
{
   const std::string prefix = "tie." + tie.Name() + ".";
   const TieDiagnostics now = Diagnose(tie, moved);
   const Point3 sum = Sum(now.source_force, 1.0, now.destination_force);
   AddPoint(row, prefix + "force_", now.destination_force);
   row.emplace_back(prefix + "force_error", Length(sum));
   const Point3 moment = Sum(now.source_moment, 1.0, now.destination_moment);
   AddPoint(row, prefix + "moment_", now.destination_moment);
   row.emplace_back(prefix + "moment_error", Length(moment));
   row.emplace_back(prefix + "displacement_jump", now.jumps.displacement);
   if (tie.Scales().exchanges)
   {
      row.emplace_back(prefix + "pressure_jump", now.jumps.pressure);
      row.emplace_back(prefix + "fluid_exchange", now.fluid_exchange);
   }
}
} // namespace

History::Row StepDiagnostics(BiphasicProblem &problem, TimeStepper &stepper,
                             const StepReport &report)
{
   History::Row row{{"t", report.time}, {"dt", report.dt}};
   for (const BiphasicProblem::Support &support : problem.Supports())
   {
      AddPoint(row, "reaction." + support.boundary + ".",
               problem.Reaction(support));
   }
   BiphasicOperator &op = problem.Operator();
   const Vector &displacement = stepper.State().GetBlock(0);
   AddSprings(row, problem, displacement);
   for (const RigidSurfaces::Travel &travel :
        op.Equations().Rigid().GetTravel(displacement))
   {
      row.emplace_back("travel." + travel.name, travel.distance);
   }
   for (const BiphasicProblem::RigidBodyState &body : problem.RigidBodyStates())
   {
      const std::string prefix = "rigid_body." + body.name + ".";
      AddPoint(row, prefix + "translation_", TranslationOf(body.pose));
      AddPoint(row, prefix + "rotation_", RotationOf(body.pose));
      AddPoint(row, prefix + "force_", body.force);
      AddPoint(row, prefix + "moment_", body.moment);
   }
   for (const BiphasicProblem::LigamentState &ligament :
        problem.LigamentStates())
   {
      const std::string prefix = "ligament." + ligament.name + ".";
      row.emplace_back(prefix + "length", ligament.length);
      row.emplace_back(prefix + "force", ligament.force);
   }
   for (const BiphasicProblem::JointState &joint : problem.JointStates())
   {
      const std::string prefix = "joint." + joint.name + ".";
      for (int k = 0; k < 6; k++)
      {
         const std::string &name = JointCoordinateNames()[k];
         row.emplace_back(prefix + name, joint.coordinates[k]);
         if (joint.prescribed[k])
         {
            row.emplace_back(prefix + name + (k < 3 ? "_moment" : "_force"),
                             joint.drives[k]);
         }
      }
   }
   for (const ContactPair *pair : op.Pairs())
   {
      AddContact(row, *pair);
   }
   Vector moved(displacement);
   if (problem.GetDeformation() == Deformation::infinitesimal)
   {
      moved = 0.0;
   }
   for (const TiedInterface *tie : op.Interfaces())
   {
      AddTie(row, *tie, moved);
   }
   const Vector &pressure = stepper.State().GetBlock(1);
   row.emplace_back("fluid.growth", op.Balance().growth);
   row.emplace_back("fluid.outflow", op.Balance().outflow);
   if (op.Balance().supply)
   {
      row.emplace_back("fluid.supply", *op.Balance().supply);
   }
   row.emplace_back("fluid.volume_balance", op.Balance().error);
   row.emplace_back(
      "fluid.peak_pressure",
      MaxOverRanks(pressure.Size() > 0 ? pressure.Normlinf() : 0.0,
                   problem.Mesh().GetComm()));
   row.emplace_back("solver.newton", report.solve.newton);
   row.emplace_back("solver.augmentations", report.solve.augmentations);
   row.emplace_back("solver.linear", report.solve.linear);
   row.emplace_back("solver.most_linear", report.solve.most_linear);
   row.emplace_back("solver.assemblies", report.work.assemblies);
   row.emplace_back("solver.searches", report.work.searches);
   row.emplace_back("solver.setups", report.work.setups);
   row.emplace_back("solver.factorisations", report.work.factorizations);
   row.emplace_back("solver.columns", report.work.columns);
   row.emplace_back("solver.seconds", report.seconds);
   return row;
}

void AddStrains(History::Row &row, const StrainExtremes &strains)
{
   row.emplace_back("strain.max_principal", strains.max_principal.value);
   row.emplace_back("strain.min_det_F", strains.min_det_F.value);
}

} // namespace synovia
