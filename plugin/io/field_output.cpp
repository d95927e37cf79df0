#include "synovia/io/field_output.hpp"
#include "synovia/contact/contact_diagnostics.hpp"
#include "synovia/fem/deformation_recovery.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
/// -kappa (grad p - rho b) with the table's permeability and an acceleration.
class RelativeFlux : public VectorCoefficient
{
public:
   RelativeFlux(const ParGridFunction &pressure_,
                const MaterialTable &materials_, const Point3 &acceleration_)
      : VectorCoefficient(3), pressure(pressure_), materials(materials_),
        acceleration(acceleration_)
   {
   }
   void Eval(Vector &value, ElementTransformation &trans,
             const IntegrationPoint &ip) override
   {
      trans.SetIntPoint(&ip);
      pressure.GetGradient(trans, value);
      const Material &material = materials.Get(trans.Attribute);
      for (int d = 0; d < 3; d++)
      {
         value[d] -= material.fluid_density * acceleration[d];
      }
      value *= material.HasFluid()
                  ? -material.permeability->GetPermeability(trans, ip)
                  : 0.0;
   }

private:
   const ParGridFunction &pressure;
   const MaterialTable &materials;
   Point3 acceleration;
};

/// -k (grad_x p - rho b) = -F K (grad p - rho F^T b)/J of deformed bodies, per
/// current area.
class DeformedRelativeFlux : public VectorCoefficient
{
public:
   DeformedRelativeFlux(const ParGridFunction &displacement_,
                        const ParGridFunction &pressure_,
                        const MaterialTable &materials_,
                        const Point3 &acceleration_)
      : VectorCoefficient(3), displacement(displacement_), pressure(pressure_),
        materials(materials_), acceleration(acceleration_)
   {
   }
   void Eval(Vector &value, ElementTransformation &trans,
             const IntegrationPoint &ip) override
   {
      const Material &material = materials.Get(trans.Attribute);
      value.SetSize(3);
      value = 0.0;
      if (!material.HasFluid())
      {
         return;
      }
      trans.SetIntPoint(&ip);
      displacement.GetVectorGradient(trans, gradient);
      pressure.GetGradient(trans, slope);
      Tensor3<> F = IdentityTensor();
      for (int k = 0; k < 9; k++)
      {
         F[k / 3][k % 3] += gradient(k / 3, k % 3);
      }
      for (int c = 0; c < 3; c++)
      {
         for (int d = 0; d < 3; d++)
         {
            slope[c] -= material.fluid_density * F[d][c] * acceleration[d];
         }
      }
      Tensor3<> conductance{};
      material.permeability->GetReferential({trans, ip}, F, conductance,
                                            nullptr);
      const Tensor3<> spatial = Product(F, conductance);
      for (int i = 0; i < 3; i++)
      {
         value[i] = -(spatial[i][0] * slope[0] + spatial[i][1] * slope[1] +
                      spatial[i][2] * slope[2]) /
                    det(F);
      }
   }

private:
   const ParGridFunction &displacement;
   const ParGridFunction &pressure;
   const MaterialTable &materials;
   Point3 acceleration;
   DenseMatrix gradient;
   Vector slope;
};
} // namespace

/// Fields of finite deformation only.
class FieldOutput::Strains
{
public:
   Strains(BiphasicProblem &problem, StressRecovery &stress_)
      : recovery(problem.Spaces().Displacement(), problem.Materials()),
        stress(stress_), largest(&stress.VectorSpace()),
        smallest(&stress.VectorSpace())
   {
   }

   void Register(ParaViewOutput &output)
   {
      output.Register("principal_strain", recovery.PrincipalStrain());
      output.Register("volume_ratio", recovery.VolumeRatio());
      output.Register("porosity", recovery.Porosity());
      output.Register("largest_stress_direction", largest);
      output.Register("smallest_stress_direction", smallest);
   }

   void Update(const ParGridFunction &displacement)
   {
      recovery.Update(displacement);
      stress.GetDirections(largest, smallest);
   }

private:
   DeformationRecovery recovery;
   StressRecovery &stress;
   ParGridFunction largest;
   ParGridFunction smallest;
};

/// The fields on the destination of one pair.
class FieldOutput::Surface
{
public:
   Surface(const std::string &directory, const ContactPair &pair_,
           ParMesh &mesh, BiphasicSpaces &spaces, bool append)
      : pair(pair_), surface(ParSubMesh::CreateFromBoundary(
                        mesh, pair.Geometry().Destination().Boundary())),
        elements(1, 2), space(&surface, &elements),
        parent(&spaces.Multiplier()), pressure(&space), gap(&space),
        status(&space), friction(&space), sliding(&space),
        output(directory, "contact_" + pair.Name(), surface, 1, append)
   {
      output.Register("contact_pressure", pressure);
      output.Register("gap", gap);
      output.Register("contact_status", status);
      if (pair.State().rubs)
      {
         output.Register("friction", friction);
         output.Register("sliding", sliding);
      }
   }

   void Save(int cycle, real_t time)
   {
      Transfer(PresentTraction(pair), pressure);
      pressure.Neg();
      Transfer(pair.State().gap, gap);
      Transfer(pair.State().Touching(), status);
      if (pair.State().rubs)
      {
         Transfer(PresentFriction(pair), friction);
         Transfer(pair.State().friction.Sliding(), sliding);
      }
      output.Save(cycle, time);
   }

private:
   void Transfer(const Vector &at_vertices, ParGridFunction &field)
   {
      parent.SetFromTrueDofs(
         pair.Geometry().Destination().Vertices().ToTrueDofs(at_vertices));
      parent.HostRead();
      surface.Transfer(parent, field);
   }

   const ContactPair &pair;
   ParSubMesh surface;
   H1_FECollection elements;
   ParFiniteElementSpace space;
   ParGridFunction parent;
   ParGridFunction pressure;
   ParGridFunction gap;
   ParGridFunction status;
   ParGridFunction friction;
   ParGridFunction sliding;
   ParaViewOutput output;
};

FieldOutput::FieldOutput(const std::string &directory,
                         BiphasicProblem &problem_, TimeStepper &stepper_,
                         bool append)
   : problem(problem_), stepper(stepper_),
     stress(problem.Spaces().Displacement(), problem.Materials(),
            problem.GetDeformation()),
     flux_space(&problem.Mesh().Get(), problem.Spaces().Pressure().FEColl(), 3),
     velocity(&problem.Spaces().Displacement()), flux(&flux_space),
     bodies(directory + "/fields", "bodies", problem.Mesh().Get(),
            std::max(1, problem.Spaces().Order()), append)
{
   bodies.Register("displacement", stepper.Displacement());
   bodies.Register("velocity", velocity);
   bodies.Register("fluid_pressure", stepper.Pressure());
   bodies.Register("relative_flux", flux);
   bodies.Register("total_stress", stress.Total());
   bodies.Register("effective_stress", stress.Effective());
   bodies.Register("principal_stress", stress.Principal());
   if (problem.GetDeformation() == Deformation::finite)
   {
      strains = std::make_unique<Strains>(problem, stress);
      strains->Register(bodies);
   }
   for (const ContactPair *pair : problem.Operator().Pairs())
   {
      surfaces.push_back(std::make_unique<Surface>(directory + "/fields", *pair,
                                                   problem.Mesh().Get(),
                                                   problem.Spaces(), append));
   }
}

FieldOutput::~FieldOutput() = default;

void FieldOutput::Update()
{
   stress.Update(stepper.Displacement(), stepper.Pressure());
   velocity.SetFromTrueDofs(stepper.Velocity());
   velocity.HostRead();
   const Point3 acceleration = problem.Acceleration(stepper.Time());
   if (strains)
   {
      strains->Update(stepper.Displacement());
      DeformedRelativeFlux in_space(stepper.Displacement(), stepper.Pressure(),
                                    problem.Materials(), acceleration);
      flux.ProjectDiscCoefficient(in_space, GridFunction::ARITHMETIC);
      return;
   }
   RelativeFlux coefficient(stepper.Pressure(), problem.Materials(),
                            acceleration);
   flux.ProjectDiscCoefficient(coefficient, GridFunction::ARITHMETIC);
}

void FieldOutput::Save()
{
   Update();
   const int cycle = stepper.Steps();
   bodies.Save(cycle, stepper.Time());
   for (const auto &surface : surfaces)
   {
      surface->Save(cycle, stepper.Time());
   }
}

} // namespace synovia
