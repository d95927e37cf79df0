//                  Two curved layers in contact, of any size
//
// What a contact problem costs, and how many iterations it takes: a mesh that
// is made in memory and one row of numbers for each run.
//
//          | u_z = -approach in equal steps
//      +-------------------+
//      |   upper layer   __|   E x jump, follows the paraboloid z = r^2/(2 R)
//      |________-----~~~~  :
//      +-------------------+   E 0.5 MPa; both: nu 0.1, kappa 1e-3 mm^4/(N s),
//      |   lower layer     |   1 mm thick, 2 mm wide
//      +-------------------+
//      /////////////////////   R = 10 mm, approach = 0.1 mm
//
// A quarter is modeled, by hexahedra or tetrahedra whose edges don't match
// between the layers. Bones are impermeable, rims and surfaces without contact
// drain freely. With --no-contact a normal traction of 0.1 E presses on the
// surfaces between the layers instead, which drain, or, with --compression,
// these are moved. With --compression layers slide on their bones. Each step is
// --step long and has the same share of the load, whatever the step. Units are
// mm, N, s, MPa.
//
// With --deformation finite the solid is neo-Hookean and the permeability
// constant, or, with --law holmes_mow, both are those of Holmes & Mow (beta
// 0.5, M 2, alpha 2, solid fraction 0.2).
//
// Linear systems are solved to --tolerance each, unlike those of other
// programs, which solve less accurately while the active set changes
// (--active-set-tolerance).
//
// scripts/benchmark makes tables and plots of many such runs. The exit status
// is 3 if a step did not converge, which the row says too.
//
// Sample runs:
//   scaling
//   mpirun -np 2 scaling --elements tet --size 10 --solver block_amg
//   mpirun -np 2 scaling --order 1 --size 24 --csv scaling.csv
//   scaling --order 3 --size 4 --jump 1e4 --solver block_amg
//   scaling --no-contact --deformation finite --compression 0.3

#include "audit/rank_record.hpp"

#include "synovia/general/option_range.hpp"
#include "synovia/general/profiled_phase.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/general/resource_use.hpp"
#include "synovia/io/csv_row.hpp"
#include "synovia/mesh/layers_estimate.hpp"
#include "synovia/synovia.hpp"

#include <algorithm>
#include <iostream>

using namespace mfem;
using namespace synovia;

namespace
{

constexpr real_t young = 0.5;
constexpr real_t thickness = 1.0;
constexpr real_t compressed = 0.05;
constexpr real_t pressed = 0.1;

struct Options
{
   const char *elements = "hex";
   const char *solver = "auto";
   const char *deformation = "infinitesimal";
   const char *law = "neo_hookean";
   const char *csv = "";
   const char *rank_records = "";
   int size = 8;
   int upper_size = 0;
   int refine = 0;
   int order = 2;
   int steps = 2;
   real_t permeability = 1e-3;
   real_t step = 1.0;
   real_t poisson = 0.1;
   real_t jump = 1.0;
   real_t compression = 0.0;
   real_t penalty_factor = ContactOptions().penalty_factor;
   real_t tolerance = LinearOptions().relative_tolerance;
   real_t active_set_tolerance = 0.0;
   bool contact = true;

   bool Parse(int argc, char *argv[])
   {
      OptionsParser args(argc, argv);
      args.AddOption(&elements, "-e", "--elements", "hex or tet.");
      args.AddOption(&size, "-n", "--size",
                     "Cells of the lower layer along an edge.");
      args.AddOption(&upper_size, "-nu", "--upper-size",
                     "The same for the upper layer; 0: three quarters of it.");
      args.AddOption(&refine, "-r", "--refine",
                     "Split all elements so often after they are distributed.");
      args.AddOption(&order, "-o", "--order",
                     "Order of the displacement; 1 is stabilized.");
      args.AddOption(&permeability, "-k", "--permeability",
                     "Permeability (mm^4/(N s)).");
      args.AddOption(&step, "-dt", "--step", "Time step (s).");
      args.AddOption(&steps, "-s", "--steps", "Number of steps.");
      args.AddOption(&poisson, "-p", "--poisson", "Poisson's ratio.");
      args.AddOption(&jump, "-j", "--jump",
                     "How many times stiffer the upper layer is.");
      args.AddOption(&deformation, "-d", "--deformation",
                     "infinitesimal or finite.");
      args.AddOption(&law, "-l", "--law",
                     "neo_hookean or holmes_mow, in finite deformation.");
      args.AddOption(&compression, "-co", "--compression",
                     "Part of its thickness that a layer loses; 0: 0.05 in "
                     "contact, else what a pressure makes of it.");
      args.AddOption(&penalty_factor, "-pf", "--penalty-factor",
                     "Factor of both derived penalties.");
      args.AddOption(&contact, "-c", "--contact", "-nc", "--no-contact",
                     "Let the layers touch, or press on each of them.");
      args.AddOption(&solver, "-ls", "--solver", "auto, block_amg or direct.");
      args.AddOption(&tolerance, "-tol", "--tolerance",
                     "Relative tolerance of the linear systems.");
      args.AddOption(&active_set_tolerance, "-ast", "--active-set-tolerance",
                     "Relative accuracy that suffices to find the active set; "
                     "0 solves every linear system to the end.");
      args.AddOption(&csv, "-csv", "--csv",
                     "Append a row to this file, which is made if need be.");
      args.AddOption(&rank_records, "-rr", "--rank-records",
                     "What each rank holds goes to this name with .RANK.csv.");
      if (!ParseCommandLine(args))
      {
         return false;
      }
      Verify();
      return true;
   }

   void Verify() const
   {
      IsFinite();
      IsHolmesMow();
      VerifyAtLeast("--size", size, 1);
      VerifyAtLeast("--upper-size", upper_size, 0);
      VerifyFrom("--refine", refine, 0, 20);
      VerifyFrom("--order", order, 1, 8);
      VerifyAtLeast("--steps", steps, 1);
      VerifyPositive("--step", step);
      VerifyPositive("--permeability", permeability);
      VerifyBetween("--poisson", poisson, -1.0, 0.5);
      VerifyPositive("--jump", jump);
      VerifyFrom("--compression", compression, 0.0, 0.9);
      VerifyPositive("--penalty-factor", penalty_factor);
      VerifyBetween("--tolerance", tolerance, 0.0, 0.1);
      VerifyFrom("--active-set-tolerance", active_set_tolerance, 0.0, 0.1);
   }

   bool IsFinite() const
   {
      return Chosen("--deformation", deformation, "infinitesimal", "finite");
   }

   bool IsHolmesMow() const
   {
      return Chosen("--law", law, "neo_hookean", "holmes_mow");
   }

   /// Whether the second of two words was given.
   static bool Chosen(const std::string &option, const std::string &word,
                      const std::string &first, const std::string &second)
   {
      if (word != first && word != second)
      {
         throw Error(option + " is " + first + " or " + second + ", not \"" +
                     word + "\"");
      }
      return word == second;
   }

   LayersOptions Layers() const
   {
      LayersOptions layers;
      layers.type = Chosen("--elements", elements, "hex", "tet")
                       ? Element::TETRAHEDRON
                       : Element::HEXAHEDRON;
      layers.lower_cells = size;
      layers.upper_cells =
         upper_size != 0 ? upper_size : static_cast<int>((3LL * size + 2) / 4);
      layers.refine = refine;
      return layers;
   }

   TimeOptions Times() const
   {
      TimeOptions times;
      times.step = step;
      times.end = steps * step;
      // Another step would be another problem.
      times.cut_back = false;
      return times;
   }
};

/// What the layers are made of, and what presses them together.
class Joint
{
public:
   Joint(const Options &options, NamedMesh &mesh)
      : lower(MakeSolid(options, young)),
        upper(MakeSolid(options, young * options.jump)),
        permeability(MakePermeability(options)), problem(mesh, Space(options))
   {
      const real_t end = options.Times().end;
      problem.SetMaterial("lower", *lower, *permeability);
      problem.SetMaterial("upper", *upper, *permeability);
      // Squeezed far, layers slide on their bones: where they were fixed, the
      // rims' corners would fold.
      if (!(options.compression > 0.0))
      {
         for (const int sideways : {0, 1})
         {
            problem.PrescribeDisplacement("lower_bone", sideways, 0.0);
            problem.PrescribeDisplacement("upper_bone", sideways, 0.0);
         }
      }
      problem.PrescribeDisplacement("lower_bone", 2, 0.0);
      problem.PrescribeDisplacement("symmetry_x", 0, 0.0);
      problem.PrescribeDisplacement("symmetry_y", 1, 0.0);
      problem.PrescribePressure("rims", 0.0);
      if (options.contact)
      {
         ContactOptions contact;
         contact.penalty_factor = options.penalty_factor;
         const real_t lost =
            options.compression > 0.0 ? options.compression : compressed;
         const real_t approach = 2.0 * lost * thickness;
         problem.PrescribeDisplacement("upper_bone", 2, Ramp(end, -approach));
         problem.AddContact("upper_contact", "lower_contact", contact);
      }
      else
      {
         problem.PrescribeDisplacement("upper_bone", 2, 0.0);
         problem.PrescribePressure("lower_contact", 0.0);
         problem.PrescribePressure("upper_contact", 0.0);
         const real_t lost = options.compression * thickness;
         if (lost > 0.0)
         {
            problem.PrescribeDisplacement("lower_contact", 2, Ramp(end, -lost));
            problem.PrescribeDisplacement("upper_contact", 2, Ramp(end, lost));
         }
         else
         {
            Press("lower_contact", pressed * young, end);
            Press("upper_contact", pressed * young * options.jump, end);
         }
      }
      NonlinearOptions nonlinear;
      nonlinear.active_set_tolerance = options.active_set_tolerance;
      nonlinear.linear.method = LinearMethodNamed(options.solver);
      nonlinear.linear.relative_tolerance = options.tolerance;
      problem.SetNonlinearOptions(nonlinear);
   }
   BiphasicProblem &Problem() { return problem; }

private:
   static SpaceOptions Space(const Options &options)
   {
      SpaceOptions space;
      space.order = options.order;
      space.deformation =
         options.IsFinite() ? Deformation::finite : Deformation::infinitesimal;
      return space;
   }

   static std::unique_ptr<SolidLaw> MakeSolid(const Options &options,
                                              real_t modulus)
   {
      if (!options.IsFinite())
      {
         return std::make_unique<IsotropicElastic>(modulus, options.poisson);
      }
      if (options.IsHolmesMow())
      {
         constexpr real_t beta = 0.5;
         return std::make_unique<HolmesMow>(modulus, options.poisson, beta);
      }
      return std::make_unique<NeoHookean>(modulus, options.poisson);
   }

   static std::unique_ptr<PermeabilityLaw>
   MakePermeability(const Options &options)
   {
      const real_t value = options.permeability;
      if (options.IsFinite() && options.IsHolmesMow())
      {
         constexpr real_t m = 2.0;
         constexpr real_t alpha = 2.0;
         constexpr real_t solid_fraction = 0.2;
         return std::make_unique<HolmesMowPermeability>(value, m, alpha,
                                                        solid_fraction);
      }
      return std::make_unique<ConstantPermeability>(value);
   }

   void Press(const std::string &surface, real_t pressure, real_t end)
   {
      problem.AddNormalTraction(surface, Ramp(end, -pressure));
   }

   std::unique_ptr<SolidLaw> lower;
   std::unique_ptr<SolidLaw> upper;
   std::unique_ptr<PermeabilityLaw> permeability;
   BiphasicProblem problem;
};

/// What all steps took.
struct Totals
{
   int steps = 0;
   int newton = 0;
   int augmentations = 0;
   int linear = 0;
   int most_linear = 0;
   real_t decades = 0.0;
   WorkCounts work;
   /// Why the run ended early; empty if it did not.
   std::string reason;
   real_t area = 0.0;

   void Add(const StepReport &report)
   {
      newton += report.solve.newton;
      augmentations += report.solve.augmentations;
      linear += report.solve.linear;
      most_linear = std::max(most_linear, report.solve.most_linear);
      decades += report.solve.decades;
      work += report.work;
      area = report.contact_area;
      reason = report.reason;
      steps += report.converged;
   }
};

Totals March(TimeStepper &stepper)
{
   Totals totals;
   while (!stepper.Done() && totals.reason.empty())
   {
      totals.Add(stepper.Step());
   }
   return totals;
}

void AddOptions(const Options &options, CsvRow &row)
{
   row.Add("elements", options.elements);
   row.Add("size", options.size);
   row.Add("upper_size", options.Layers().upper_cells);
   row.Add("refine", options.refine);
   row.Add("order", options.order);
   row.Add("permeability", options.permeability);
   row.Add("step", options.step);
   row.Add("poisson", options.poisson);
   row.Add("jump", options.jump);
   row.Add("penalty_factor", options.penalty_factor);
   row.Add("contact", options.contact ? 1 : 0);
   row.Add("deformation", options.deformation);
   row.Add("law", options.IsFinite() ? options.law : "linear");
   row.Add("compression", options.compression);
   row.Add("tolerance", options.tolerance);
   row.Add("active_set_tolerance", options.active_set_tolerance);
}

void AddTotals(const Totals &totals, CsvRow &row)
{
   row.Add("converged", totals.reason.empty() ? 1 : 0);
   row.Add("steps", totals.steps);
   row.Add("newton", totals.newton);
   row.Add("augmentations", totals.augmentations);
   row.Add("linear", totals.linear);
   row.Add("most_linear", totals.most_linear);
   row.Add("mean_linear", totals.linear / std::max(1.0, 1.0 * totals.newton));
   row.Add("linear_per_decade", totals.linear / std::max(1.0, totals.decades));
   row.Add("assemblies", totals.work.assemblies);
   row.Add("searches", totals.work.searches);
   row.Add("setups", totals.work.setups);
   row.Add("factorisations", totals.work.factorizations);
   row.Add("columns", totals.work.columns);
}

/// Elements of the rank that has the most, over the mean.
real_t Imbalance(const ParMesh &mesh)
{
   const real_t mine = mesh.GetNE();
   return MaxOverRanks(mine, mesh.GetComm()) * mesh.GetNRanks() /
          SumOverRanks(mine, mesh.GetComm());
}

real_t Dofs(BiphasicProblem &problem)
{
   return static_cast<real_t>(
      problem.Spaces().Displacement().GlobalTrueVSize() +
      problem.Spaces().Pressure().GlobalTrueVSize());
}

void AddSize(BiphasicProblem &problem, CsvRow &row)
{
   const ParMesh &mesh = problem.Mesh().Get();
   row.Add("ranks", mesh.GetNRanks());
   row.Add("cells", mesh.GetGlobalNE());
   row.Add("dofs", Dofs(problem));
   row.Add("imbalance", Imbalance(mesh));
   const LinearMethod method =
      problem.Operator().LinearSolver().Options().method;
   for (const auto &[word, value] : LinearMethodWords())
   {
      if (value == method)
      {
         row.Add("solver", word);
      }
   }
}

void AddRates(BiphasicProblem &problem, const Totals &totals, real_t seconds,
              CsvRow &row)
{
   const ResourceUse use = GetResourceUse(MPI_COMM_WORLD);
   row.Add("dofs_per_second", totals.steps * Dofs(problem) /
                                 MaxOverRanks(seconds, MPI_COMM_WORLD));
   row.Add("cpu_seconds", use.cpu_seconds);
   row.Add("memory_sum", use.memory_sum);
   row.Add("memory_max", use.memory_max);
}

/// How much of the problem this rank has.
void AddShare(BiphasicProblem &problem, RankRecord &record)
{
   BiphasicSpaces &spaces = problem.Spaces();
   record.Add("elements", spaces.GetMesh().GetNE());
   record.Add("dofs", spaces.Displacement().GetTrueVSize() +
                         spaces.Pressure().GetTrueVSize());
   real_t faces = 0.0;
   for (const ContactPair *pair : problem.Operator().Pairs())
   {
      faces +=
         static_cast<real_t>(pair->Geometry().Source().Faces().size() +
                             pair->Geometry().Destination().Faces().size());
   }
   record.Add("contact_faces", faces);
   SparseMatrix rows;
   problem.Operator()
      .Equations()
      .Bodies()
      .Tangent()
      .stiffness->MergeDiagAndOffd(rows);
   record.Add("entries", rows.NumNonZeroElems());
}

/// What the results can be checked by.
void AddResults(BiphasicProblem &problem, const Totals &totals, CsvRow &row)
{
   for (const BiphasicProblem::Support &support : problem.Supports())
   {
      if (support.boundary == "upper_bone")
      {
         row.Add("force", problem.Reaction(support)[2]);
      }
   }
   real_t error = 0.0;
   for (const ContactPair *pair : problem.Operator().Pairs())
   {
      const ContactDiagnostics now = Diagnose(*pair);
      const Point3 sum = Sum(now.source_force, 1.0, now.destination_force);
      const real_t size = Length(now.source_force);
      error = size > 0.0 ? Length(sum) / size : 0.0;
   }
   row.Add("force_error", error);
   row.Add("contact_area", totals.area);
}

/// Of the rank that takes longest in each; @a mesh and @a total as well.
void AddTimes(const PhaseTimes &phases, real_t mesh, real_t total, CsvRow &row)
{
   const auto add = [&](const std::string &name, real_t seconds)
   { row.Add("seconds_" + name, MaxOverRanks(seconds, MPI_COMM_WORLD)); };
   add("mesh", mesh);
   add("assembly", phases.assembly);
   add("search", phases.search);
   add("setup", phases.setup);
   add("solve", phases.linear);
   add("total", total);
}

NamedMesh MakeLayers(const Options &options)
{
   const ProfiledPhase phase("mesh");
   return MakeCurvedLayers(options.Layers(), MPI_COMM_WORLD);
}

int Run(int argc, char *argv[])
{
   Options options;
   if (!options.Parse(argc, argv))
   {
      return 0;
   }
   VerifySize(EstimateLayers(options.Layers(), options.order), MPI_COMM_WORLD);
   RankRecord record;
   StopWatch watch;
   watch.Start();
   NamedMesh mesh = MakeLayers(options);
   const real_t mesh_seconds = watch.RealTime();
   record.AddMemoryOf("mesh");
   Joint joint(options, mesh);
   BiphasicProblem &problem = joint.Problem();
   problem.Operator();
   record.AddMemoryOf("equations");
   TimeStepper stepper(problem, options.Times());
   const Totals totals = March(stepper);
   const real_t seconds = watch.RealTime() - mesh_seconds;
   record.AddMemoryOf("steps");

   CsvRow row;
   AddOptions(options, row);
   AddSize(problem, row);
   AddTotals(totals, row);
   AddTimes(problem.Operator().Times(), mesh_seconds, seconds, row);
   AddRates(problem, totals, seconds, row);
   AddResults(problem, totals, row);
   row.Add("reason", totals.reason);
   if (Mpi::Root())
   {
      row.Print(std::cout);
   }
   if (*options.csv)
   {
      row.AppendTo(options.csv, MPI_COMM_WORLD);
   }
   if (*options.rank_records)
   {
      AddShare(problem, record);
      record.AddMemoryOfAll();
      record.Write(std::string(options.rank_records) + "." +
                   std::to_string(Mpi::WorldRank()) + ".csv");
   }
   return totals.reason.empty() ? 0 : 3;
}

} // namespace

int main(int argc, char *argv[])
{
   Mpi::Init(argc, argv);
   Hypre::Init();
   return RunMain("scaling", Run, argc, argv);
}
