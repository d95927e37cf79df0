// What a project of somebody else does with the installed library: two layers
// of cartilage, pressed together.

#include "synovia/synovia.hpp"

#include <cmath>
#include <iostream>

using namespace mfem;

namespace
{

synovia::NamedMesh TwoLayers()
{
   Mesh lower = Mesh::MakeCartesian3D(3, 3, 2, Element::HEXAHEDRON);
   Mesh upper = Mesh::MakeCartesian3D(2, 2, 2, Element::HEXAHEDRON);
   for (int i = 0; i < upper.GetNV(); i++)
   {
      upper.GetVertex(i)[2] += 1.0;
   }
   for (int i = 0; i < upper.GetNE(); i++)
   {
      upper.SetAttribute(i, 2);
   }
   for (int i = 0; i < upper.GetNBE(); i++)
   {
      upper.SetBdrAttribute(i, upper.GetBdrAttribute(i) + 6);
   }
   upper.SetAttributes();
   Mesh *both[2] = {&lower, &upper};
   Mesh serial(both, 2);
   return synovia::DistributeMesh(serial, {{"lower", {1}}, {"upper", {2}}},
                                  {{"lower_bone", {1}},
                                   {"lower_surface", {6}},
                                   {"upper_surface", {7}},
                                   {"upper_bone", {12}}},
                                  MPI_COMM_WORLD);
}

int Run(int, char **)
{
   synovia::NamedMesh mesh = TwoLayers();
   const synovia::IsotropicElastic solid(0.5, 0.1);
   const synovia::ConstantPermeability permeability(4.0e-3);
   synovia::BiphasicProblem problem(mesh, synovia::SpaceOptions());
   problem.SetMaterial("lower", solid, permeability);
   problem.SetMaterial("upper", solid, permeability);
   problem.FixDisplacement("lower_bone");
   problem.PrescribeDisplacement("upper_bone", 0, 0.0);
   problem.PrescribeDisplacement("upper_bone", 1, 0.0);
   problem.PrescribeDisplacement("upper_bone", 2, synovia::Ramp(10.0, -0.05));
   problem.AddContact("upper_surface", "lower_surface");

   synovia::TimeOptions times;
   times.step = 5.0;
   times.end = 20.0;
   synovia::TimeStepper stepper(problem, times);
   while (!stepper.Done())
   {
      const synovia::StepReport report = stepper.Step();
      if (!report.converged)
      {
         throw synovia::Error(report.reason);
      }
   }
   const synovia::ContactDiagnostics contact =
      Diagnose(*problem.Operator().Pairs().front());
   const real_t force = contact.source_force[2];
   if (Mpi::Root())
   {
      std::cout << "the layers press with " << force << std::endl;
   }
   // The drained solid with free sides bears E x strain; what fluid is left and
   // the bonded ends add to that.
   const bool balanced =
      std::abs(force + contact.destination_force[2]) <= 1e-10 * force;
   return force > 0.5 * 0.025 && balanced ? 0 : 1;
}

} // namespace

int main(int argc, char *argv[])
{
   Mpi::Init(argc, argv);
   Hypre::Init();
   return synovia::RunMain("consumer", Run, argc, argv);
}
