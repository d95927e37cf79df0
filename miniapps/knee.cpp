//                              Contact in a knee
//
// Guo & Spilker, Comput Methods Biomech Biomed Engin 17(11):1206-1216, 2014,
// section 3.3: femoral cartilage, both tibial cartilages and both menisci, in
// six contact pairs.
//
//       ______________________     the bone side of the femoral cartilage goes
//      (   femoral cartilage  )    down by 0.8 mm in 100 s, then stays
//       \_____        ______/
//     ____    \______/    ____
//    |___ \_            _/ ___|    menisci: fibers run around the axes of two
//     ======    ======   ======    cylindrical frames; springs at four horns
//      tibial cartilages           fixed, impermeable bone below
//
// Cartilage: E 0.69 MPa, nu 0.018, permeability 3.0e-3 mm^4/(N s). Menisci:
// E_r = E_z = 0.075 MPa, E_theta 100 MPa, nu_rtheta 0.0015, nu_rz 0.5,
// permeability 1.26e-3 mm^4/(N s). The paper leaves the shear modulus along the
// fibers out; 0.05 MPa lies between the magnitudes measured in oscillation for
// bovine menisci (0.02 to 0.04 MPa: Zhu, Chern & Mow, Clin Orthop Relat Res
// 306:34-45, 1994) and those of stiffer tissue, and --shear sets another.
// Solid content is 0.25, units are mm, N, s, MPa.
//
// The ligaments of the horns run along the tibial plateau: 2000 N/mm in both of
// its directions, and across it as much as keeps menisci in place that nothing
// touches yet.
//
// Bone and the inner edges of the menisci are impermeable; everything else, the
// ends of the horns too, drains freely where it doesn't touch. The axis of the
// medial frame is midway between the horns, the lateral one in the middle of
// the meniscus.
//
// meshes/knee_from_segmentation.py makes the mesh from an image,
// meshes/knee_parametric.py an idealized one. miniapps/cases/knee.toml is the
// same problem for the driver; scripts/plot_knee.py draws the pictures.
//
// Sample runs:
//   scripts/run_python meshes/knee_parametric.py -o knee.msh
//   mpirun -np 2 knee --mesh knee.msh
//   mpirun -np 2 knee --mesh knee.msh --order 2 --output out/order_2

#include "synovia/general/option_range.hpp"
#include "synovia/synovia.hpp"

#include <iostream>

using namespace mfem;
using namespace synovia;

namespace
{

struct Options
{
   const char *mesh = "knee.msh";
   const char *output = "out/knee";
   bool overwrite = false;
   bool resume = false;
   const char *solver = "auto";
   int order = 1;
   real_t step = 5.0;
   real_t end = 300.0;
   real_t ramp = 100.0;
   real_t approach = 0.8;
   real_t shear = 0.05;
   real_t horn = 2000.0;
   real_t horn_across = 1.0;
   int fields_every = 2;

   bool Parse(int argc, char *argv[])
   {
      OptionsParser args(argc, argv);
      args.AddOption(&mesh, "-m", "--mesh", "Mesh, of meshes/knee_*.py.");
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
      args.AddOption(&ramp, "-tr", "--ramp",
                     "How long the femoral bone moves (s).");
      args.AddOption(&approach, "-a", "--approach", "How far it moves (mm).");
      args.AddOption(&shear, "-G", "--shear",
                     "Shear modulus of the menisci along their fibers (MPa).");
      args.AddOption(&horn, "-k", "--horn",
                     "Stiffness of the springs at each horn, in each direction "
                     "of the tibial plateau (N/mm).");
      args.AddOption(&horn_across, "-ka", "--horn-across",
                     "Their stiffness across it (N/mm).");
      args.AddOption(&solver, "-ls", "--solver", "auto, block_amg or direct.");
      args.AddOption(&fields_every, "-fe", "--fields-every",
                     "Write fields every so many steps; 0 never.");
      if (!ParseCommandLine(args))
      {
         return false;
      }
      // The case that is made of them checks the others.
      VerifyPositive("--step", step);
      VerifyPositive("--end", end);
      VerifyPositive("--ramp", ramp);
      VerifyAtLeast("--horn", horn, 0.0);
      VerifyAtLeast("--horn-across", horn_across, 0.0);
      return true;
   }
};

const char *const sides[2] = {"medial", "lateral"};

std::string Tibial(const std::string &side)
{
   return "tibial_cartilage_" + side;
}

std::string Meniscus(const std::string &side)
{
   return "meniscus_" + side;
}

MaterialCase Cartilage()
{
   MaterialCase material;
   material.regions = {"femoral_cartilage", Tibial("medial"),
                       Tibial("lateral")};
   material.solid = {"isotropic", {{"E", 0.69}, {"nu", 0.018}}};
   material.permeability = {"constant", {{"value", 3.0e-3}}};
   material.solid_fraction = 0.25;
   return material;
}

MaterialCase MeniscalTissue(const std::string &side, real_t shear)
{
   MaterialCase material;
   material.regions = {Meniscus(side)};
   material.solid = {"transversely_isotropic",
                     {{"E_r", 0.075},
                      {"E_theta", 100.0},
                      {"nu_rtheta", 0.0015},
                      {"nu_rz", 0.5},
                      {"G_rtheta", shear}}};
   material.permeability = {"constant", {{"value", 1.26e-3}}};
   material.solid_fraction = 0.25;
   material.frame.type = FrameType::cylindrical;
   if (side == "medial")
   {
      material.frame.between = {Meniscus(side) + "_horn_anterior",
                                Meniscus(side) + "_horn_posterior"};
   }
   else
   {
      material.frame.around = {Meniscus(side) + "_periphery"};
   }
   return material;
}

BoundaryCase Bone(const std::vector<std::string> &surfaces,
                  const LoadCurve &along_z)
{
   BoundaryCase bone;
   bone.surfaces = surfaces;
   bone.displacement = {LoadCurve(0.0), LoadCurve(0.0), along_z};
   return bone;
}

BoundaryCase Draining(const std::vector<std::string> &surfaces)
{
   BoundaryCase open;
   open.surfaces = surfaces;
   open.pressure = LoadCurve(0.0);
   return open;
}

BoundaryCase Spring(const std::string &surface, int component, real_t stiffness)
{
   BoundaryCase boundary;
   boundary.surfaces = {surface};
   boundary.spring.stiffness = stiffness;
   boundary.spring.direction[component] = 1.0;
   return boundary;
}

ContactCase Contact(const std::string &name, const std::string &source,
                    const std::string &destination)
{
   ContactCase contact;
   contact.name = name;
   contact.source = {source};
   contact.destination = {destination};
   // Menisci slide by some millimeters.
   contact.options.configuration = SearchConfiguration::current;
   return contact;
}

void AddSide(const std::string &side, const Options &options, CaseFile &setup)
{
   const std::string femur = "femoral_cartilage_contact";
   const std::string tibia = Tibial(side) + "_contact";
   setup.materials.push_back(MeniscalTissue(side, options.shear));
   setup.boundaries.push_back(Bone({Tibial(side) + "_bone"}, LoadCurve(0.0)));
   setup.boundaries.push_back(
      Draining({Tibial(side) + "_rim", Meniscus(side) + "_periphery"}));
   for (const char *end : {"_horn_anterior", "_horn_posterior"})
   {
      setup.boundaries.push_back(Draining({Meniscus(side) + end}));
      for (int d = 0; d < 3; d++)
      {
         setup.boundaries.push_back(
            Spring(Meniscus(side) + end, d,
                   d < 2 ? options.horn : options.horn_across));
      }
   }
   setup.contacts.push_back(Contact("femur-tibia-" + side, femur, tibia));
   setup.contacts.push_back(
      Contact("tibia-meniscus-" + side, tibia, Meniscus(side) + "_inferior"));
   setup.contacts.push_back(
      Contact("meniscus-femur-" + side, femur, Meniscus(side) + "_superior"));
}

CaseFile MakeCase(const Options &options)
{
   CaseFile setup;
   setup.title = "Knee";
   setup.mesh.file = options.mesh;
   setup.space.order = options.order;
   setup.materials = {Cartilage()};
   setup.boundaries = {
      Bone({"femoral_cartilage_bone"}, Ramp(options.ramp, -options.approach)),
      Draining({"femoral_cartilage_rim"})};
   for (const char *side : sides)
   {
      AddSide(side, options, setup);
   }
   setup.time.step = options.step;
   setup.time.end = options.end;
   setup.solver.linear.method = LinearMethodNamed(options.solver);
   setup.output.directory = options.output;
   setup.output.fields_every = options.fields_every;
   return setup;
}

/// Compressive force on one side's tibial cartilage, from femur and meniscus,
/// and the area in contact there.
struct Load
{
   real_t force = 0.0;
   real_t area = 0.0;
};

Load TibialLoad(const std::string &side,
                const std::vector<ContactPair *> &pairs)
{
   Load load;
   for (const ContactPair *pair : pairs)
   {
      const ContactDiagnostics now = Diagnose(*pair);
      if (pair->Name() == "femur-tibia-" + side)
      {
         load.force -= now.destination_force[2];
         load.area += now.area;
      }
      else if (pair->Name() == "tibia-meniscus-" + side)
      {
         load.force -= now.source_force[2];
         load.area += now.area;
      }
   }
   return load;
}

void PrintLoads(Simulation &simulation)
{
   const auto &pairs = simulation.Problem().Operator().Pairs();
   for (const char *side : sides)
   {
      const Load load = TibialLoad(side, pairs);
      if (Mpi::Root())
      {
         std::cout << (side == sides[0] ? "\n" : "") << side
                   << " tibial cartilage: " << load.force << " N on "
                   << load.area << " mm^2" << std::endl;
      }
   }
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
   while (!simulation.Done())
   {
      simulation.Step();
      if (simulation.IsNow(options.ramp))
      {
         PrintLoads(simulation);
      }
      const int status = simulation.StopIfAsked();
      if (status != 0)
      {
         return status;
      }
   }
   simulation.Finish();
   return 0;
}

} // namespace

int main(int argc, char *argv[])
{
   Mpi::Init(argc, argv);
   Hypre::Init();
   return RunMain("knee", Run, argc, argv);
}
