#pragma once

#include "synovia/synovia.hpp"

namespace synovia
{

struct PressedBoxOptions
{
   int order = 1;
   Deformation deformation = Deformation::infinitesimal;
   SearchConfiguration configuration = SearchConfiguration::reference;
   /// Along x, of the box's top in all (length).
   mfem::real_t slide = 0.0;
   LinearMethod method = LinearMethod::direct;
   mfem::real_t relative_tolerance = 1e-11;
   /// Of the contact (length); 0: derived.
   mfem::real_t gap_tolerance = 0.0;
   /// Of pressure jumps, relative to the largest pressure.
   mfem::real_t pressure_tolerance = ContactOptions().pressure_tolerance;
   FrictionOptions friction;
   int max_newton = 30;
   DirectOptions direct;
   SolverTuning tuning;
   /// A rank for each of the elements; METIS decides without.
   const int *partitioning = nullptr;
   /// In the boxes if there is one; borrowed.
   mfem::VectorCoefficient *body_force = nullptr;
};

/// A box that is pressed eccentrically onto a wider layer for 40 s, and lifted
/// in part within 40 s more, so that contact comes and goes.
class PressedBox
{
public:
   PressedBox(MPI_Comm comm, const PressedBoxOptions &options);

   BiphasicProblem &Problem() { return problem; }
   const ContactPair &Pair() { return *problem.Operator().Pairs().front(); }
   /// Force of the support on the box.
   Point3 Force() { return problem.Reaction(problem.Supports().back()); }

   static constexpr mfem::real_t end = 80.0;

private:
   NamedMesh mesh;
   std::unique_ptr<SolidLaw> layer_solid;
   ConstantPermeability layer_fluid;
   std::unique_ptr<SolidLaw> box_solid;
   ConstantPermeability box_fluid;
   BiphasicProblem problem;
};

} // namespace synovia
