#include "support/pressed_box.hpp"
#include "support/boxes.hpp"
#include "synovia/materials/solids/neo_hookean.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
NamedMesh MakeBodies(MPI_Comm comm, const int *partitioning)
{
   BoxOptions layer;
   layer.nx = 5;
   layer.ny = 4;
   layer.nz = 2;
   layer.size_x = 2.0;
   layer.size_y = 2.0;
   layer.size_z = 0.5;
   layer.type = Element::TETRAHEDRON;
   BoxOptions box;
   box.nx = 3;
   box.ny = 3;
   box.nz = 1;
   box.size_z = 0.4;
   Mesh mesh = MakeStackMesh(layer, box);
   // Away from the layer's sides, and rounded underneath: contact starts at an
   // edge and grows.
   for (int i = MakeBoxMesh(layer).GetNV(); i < mesh.GetNV(); i++)
   {
      real_t *x = mesh.GetVertex(i);
      x[0] += 0.45;
      x[1] += 0.55;
      if (x[2] < 0.7)
      {
         x[2] += 0.02 * (x[0] - 0.45) * (x[0] - 0.45);
      }
   }
   return DistributeStack(mesh, comm, partitioning);
}

SpaceOptions SpaceOf(const PressedBoxOptions &options)
{
   SpaceOptions space;
   space.order = options.order;
   space.deformation = options.deformation;
   return space;
}

std::unique_ptr<SolidLaw> MakeSolid(Deformation deformation, real_t young,
                                    real_t poisson)
{
   if (deformation == Deformation::finite)
   {
      return std::make_unique<NeoHookean>(young, poisson);
   }
   return std::make_unique<IsotropicElastic>(young, poisson);
}
} // namespace

PressedBox::PressedBox(MPI_Comm comm, const PressedBoxOptions &options)
   : mesh(MakeBodies(comm, options.partitioning)),
     layer_solid(MakeSolid(options.deformation, 0.5, 0.1)), layer_fluid(4.0e-3),
     box_solid(MakeSolid(options.deformation, 5.0, 0.2)), box_fluid(4.0e-2),
     problem(mesh, SpaceOf(options))
{
   problem.SetMaterial("lower", *layer_solid, layer_fluid);
   problem.SetMaterial("upper", *box_solid, box_fluid);
   problem.FixDisplacement("lower_z0");
   problem.PrescribeDisplacement("upper_z1", 0,
                                 LoadCurve({0.0, end}, {0.0, options.slide}));
   problem.PrescribeDisplacement("upper_z1", 1, 0.0);
   // Down, and up again as far as to where it lifts off in part.
   problem.PrescribeDisplacement(
      "upper_z1", 2, LoadCurve({0.0, 40.0, end}, {0.0, -0.03, -0.01}));
   problem.PrescribePressure("upper_z1", 0.0);
   ContactOptions contact;
   contact.configuration = options.configuration;
   contact.gap_tolerance = options.gap_tolerance;
   contact.pressure_tolerance = options.pressure_tolerance;
   contact.friction = options.friction;
   problem.AddContact("upper_z0", "lower_z1", contact);
   if (options.body_force)
   {
      problem.Conditions().AddBodyForce(*options.body_force);
   }
   NonlinearOptions nonlinear;
   nonlinear.max_newton = options.max_newton;
   nonlinear.linear.method = options.method;
   nonlinear.linear.relative_tolerance = options.relative_tolerance;
   nonlinear.linear.direct = options.direct;
   nonlinear.tuning = options.tuning;
   problem.SetNonlinearOptions(nonlinear);
}

} // namespace synovia
