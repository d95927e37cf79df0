//                Flat-ended indentation of a layer of cartilage
//
// Guo & Spilker, Comput Methods Biomech Biomed Engin 17(11):1206-1216, 2014,
// section 3.1; exact solution for a rigid punch: Mak, Lai & Mow, J Biomech
// 20:703-714, 1987.
//
//            | u_z = -0.075 mm in 500 s, then held; p = 0
//        +---+---+
//        |       |     indenter: porous cylinder, radius and height 0.75 mm,
//        |       |     E 541.7 MPa, nu 0.125, kappa 4.0 mm^4/(N s)
//    +---+-------+---+
//    |               | cartilage: thickness 0.75 mm, radius 3 mm, E 0.5417 MPa,
//    +---------------+ nu 0.0833, kappa 4.0e-3 mm^4/(N s), on fixed
//    /////////////////  impermeable bone
//
// A quarter of it is modeled; the force printed is that of the whole cylinder.
// The cartilage drains freely outside the contact, where it is sealed against
// the indenter, which is a thousand times more permeable and drains at its top.
// Units are mm, N, s, MPa. meshes/indentation.py makes the mesh.
//
// Writes to --output: history.csv, history.h5, lines/ (profiles), fields/
// (ParaView), run.log, and case.toml, with which the driver does the same.
// scripts/plot_indentation.py draws the paper's pictures from them.
//
// Sample runs (scripts/run does all of it):
//   scripts/run_python meshes/indentation.py -o indentation.msh
//   mpirun -np 2 indentation --mesh indentation.msh
//   mpirun -np 2 indentation -m indentation.msh -out out/rigid -r -s sdirk33
//   mpirun -np 2 indentation -m indentation.msh -out out/direct -ls direct

#include "synovia/general/option_range.hpp"
#include "synovia/synovia.hpp"

#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

using namespace mfem;
using namespace synovia;

namespace
{

struct Options
{
   const char *mesh = "indentation.msh";
   const char *output = "out/indentation";
   bool overwrite = false;
   bool resume = false;
   const char *scheme = "backward_euler";
   const char *solver = "auto";
   int order = 2;
   real_t step = 25.0;
   real_t end = 1500.0;
   real_t young = 0.5417;
   real_t poisson = 0.0833;
   real_t permeability = 4.0e-3;
   real_t penalty_factor = ContactOptions().penalty_factor;
   real_t active_set_tolerance = NonlinearOptions().active_set_tolerance;
   real_t check = 0.0;
   int fields_every = 10;
   bool rigid = false;

   bool Parse(int argc, char *argv[])
   {
      OptionsParser args(argc, argv);
      args.AddOption(&mesh, "-m", "--mesh", "Mesh, gmsh's MSH 2.2 or 4.1.");
      args.AddOption(&output, "-out", "--output", "Directory for the results.");
      args.AddOption(&overwrite, "-ow", "--overwrite", "-no-ow",
                     "--no-overwrite",
                     "Remove what an earlier run left there.");
      args.AddOption(&resume, "-re", "--resume", "-no-re", "--no-resume",
                     "Go on from the newest checkpoint there.");
      args.AddOption(&order, "-o", "--order",
                     "Order of the displacement; 1 is stabilized.");
      args.AddOption(&step, "-dt", "--step", "Time step (s).");
      args.AddOption(&end, "-te", "--end", "End time (s).");
      args.AddOption(&scheme, "-s", "--scheme",
                     "backward_euler, sdirk23 or sdirk33.");
      args.AddOption(&solver, "-ls", "--solver", "auto, block_amg or direct.");
      args.AddOption(&young, "-E", "--young",
                     "Young's modulus of the cartilage (MPa).");
      args.AddOption(&poisson, "-nu", "--poisson",
                     "Poisson's ratio of the cartilage.");
      args.AddOption(&permeability, "-k", "--permeability",
                     "Permeability of the cartilage (mm^4/(N s)).");
      args.AddOption(&rigid, "-r", "--rigid", "-d", "--deformable",
                     "Make the indenter a thousand times stiffer and more "
                     "permeable, as the exact solution has it.");
      args.AddOption(&penalty_factor, "-pf", "--penalty-factor",
                     "Factor of both derived penalties.");
      args.AddOption(&active_set_tolerance, "-ast", "--active-set-tolerance",
                     "Relative accuracy that suffices to find the active set; "
                     "0 solves every linear system to 1e-8.");
      args.AddOption(&fields_every, "-fe", "--fields-every",
                     "Write fields every so many steps; 0 never.");
      args.AddOption(&check, "-c", "--check",
                     "Fail if a force differs from the exact one by more than "
                     "this fraction.");
      if (!ParseCommandLine(args))
      {
         return false;
      }
      // The case that is made of them checks the others.
      VerifyPositive("--step", step);
      VerifyPositive("--end", end);
      VerifyAtLeast("--check", check, 0.0);
      return true;
   }
};

// What the paper's figures show.
std::vector<LineCase> PaperProfiles()
{
   const real_t h = 0.75;
   const auto radial = [](const char *name, real_t z, real_t length, int points,
                          const char *region, real_t time)
   {
      LineCase profile;
      profile.line.name = name;
      profile.line.from = {0.0, 0.0, z};
      profile.line.to = {length, 0.0, z};
      profile.line.points = points;
      profile.line.regions = {region};
      profile.times = {time};
      return profile;
   };
   LineCase axis;
   axis.line.name = "axis";
   axis.line.to = {0.0, 0.0, h};
   axis.line.points = 76;
   axis.line.regions = {"cartilage"};
   axis.times = {250.0, 500.0};
   // The surface itself has no shear stress; the profile nearest to it is taken
   // a thirtieth of the thickness below.
   return {radial("cartilage_top", h - 0.025, 2.99, 300, "cartilage", 500.0),
           radial("cartilage_middle", h / 2, 2.99, 300, "cartilage", 500.0),
           radial("cartilage_bottom", 0.0, 2.99, 300, "cartilage", 500.0),
           axis,
           radial("contact_cartilage", h, 0.75, 151, "cartilage", 250.0),
           radial("contact_indenter", h, 0.75, 151, "indenter", 250.0)};
}

MaterialCase Material(const char *region, real_t young, real_t poisson,
                      real_t permeability, real_t solid_fraction)
{
   MaterialCase material;
   material.regions = {region};
   material.solid = {"isotropic", {{"E", young}, {"nu", poisson}}};
   material.permeability = {"constant", {{"value", permeability}}};
   material.solid_fraction = solid_fraction;
   return material;
}

BoundaryCase Prescribed(const char *surface,
                        const std::vector<int> &fixed_components)
{
   BoundaryCase boundary;
   boundary.surfaces = {surface};
   for (const int component : fixed_components)
   {
      boundary.displacement[component] = LoadCurve(0.0);
   }
   return boundary;
}

CaseFile MakeCase(const Options &options)
{
   CaseFile setup;
   setup.title = "Flat-ended indentation of a layer of cartilage";
   setup.mesh.file = options.mesh;
   setup.space.order = options.order;
   const real_t rigidity = options.rigid ? 1000.0 : 1.0;
   setup.materials = {
      Material("cartilage", options.young, options.poisson,
               options.permeability, 0.2),
      Material("indenter", 541.7 * rigidity, 0.125, 4.0 * rigidity, 0.95)};
   setup.boundaries = {
      Prescribed("bone", {0, 1, 2}), Prescribed("symmetry_x", {0}),
      Prescribed("symmetry_y", {1}), Prescribed("indenter_top", {})};
   BoundaryCase &top = setup.boundaries.back();
   top.displacement[2] = Ramp(500.0, -0.075);
   top.pressure = LoadCurve(0.0);

   ContactCase contact;
   contact.name = "indenter-cartilage";
   contact.source = {"indenter_bottom"};
   contact.destination = {"cartilage_top"};
   contact.options.penalty_factor = options.penalty_factor;
   // The exact solution is that of small displacements.
   contact.options.configuration = SearchConfiguration::reference;
   setup.contacts = {contact};

   setup.time.step = options.step;
   setup.time.end = options.end;
   setup.time.scheme = TimeSchemeNamed(options.scheme);
   setup.solver.linear.method = LinearMethodNamed(options.solver);
   setup.solver.active_set_tolerance = options.active_set_tolerance;
   setup.output.directory = options.output;
   setup.output.fields_every = options.fields_every;
   setup.output.lines = PaperProfiles();
   return setup;
}

// Force on the whole cylinder (N), compressive, for a rigid, freely draining
// punch on an infinite layer of the default material.
struct ExactForce
{
   real_t time;
   real_t force;
};
constexpr ExactForce exact_forces[] = {
   {250.0, 0.0802910477}, {500.0, 0.1495876486}, {1500.0, 0.1383611062}};

/// Prints the force where the exact one is known; gives the relative error,
/// or 0 at other times.
real_t CompareForce(Simulation &simulation)
{
   for (const ExactForce &exact : exact_forces)
   {
      if (!simulation.IsNow(exact.time))
      {
         continue;
      }
      const ContactPair &pair =
         *simulation.Problem().Operator().Pairs().front();
      const real_t force = 4.0 * Diagnose(pair).source_force[2];
      const real_t error = force / exact.force - 1.0;
      if (Mpi::Root())
      {
         std::cout << "\nforce at " << exact.time
                   << " s: " << std::setprecision(7) << force << " N, exact "
                   << exact.force << " N (rigid punch), "
                   << std::setprecision(2) << 100.0 * error << " %"
                   << std::setprecision(6) << std::endl;
      }
      return error;
   }
   return 0.0;
}

int Run(int argc, char *argv[])
{
   Options options;
   if (!options.Parse(argc, argv))
   {
      return 0;
   }
   if (options.resume && options.overwrite)
   {
      throw Error("--resume and --overwrite exclude each other");
   }
   Simulation simulation(MakeCase(options), MPI_COMM_WORLD);
   if (options.resume)
   {
      simulation.Resume();
   }
   else if (options.overwrite)
   {
      simulation.Overwrite();
   }
   real_t worst = 0.0;
   while (!simulation.Done())
   {
      simulation.Step();
      worst = std::max(worst, std::abs(CompareForce(simulation)));
      const int status = simulation.StopIfAsked();
      if (status != 0)
      {
         return status;
      }
   }
   simulation.Finish();
   return options.check > 0.0 && worst > options.check ? 3 : 0;
}

} // namespace

int main(int argc, char *argv[])
{
   Mpi::Init(argc, argv);
   Hypre::Init();
   return RunMain("indentation", Run, argc, argv);
}
