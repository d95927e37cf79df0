#include "synovia/fem/boundary_conditions.hpp"
#include "synovia/general/error.hpp"
#include "synovia/mesh/boundary_marker.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
void AssembleInto(ParLinearForm &form, Vector &load)
{
   form.Assemble();
   load.SetSize(form.ParFESpace()->GetTrueVSize());
   form.ParallelAssemble(load);
   load.HostReadWrite();
}
} // namespace

BoundaryConditions::BoundaryConditions(BiphasicSpaces &spaces_,
                                       Deformation deformation_)
   : spaces(spaces_), deformation(deformation_), followers(spaces)
{
}

Array<int> BoundaryConditions::Marker(const Array<int> &boundary) const
{
   return BoundaryMarker(spaces.GetMesh(), boundary);
}

void BoundaryConditions::AddCorners(const LoadCurve &curve)
{
   corners.insert(corners.end(), curve.Corners().begin(),
                  curve.Corners().end());
   std::sort(corners.begin(), corners.end());
   corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
}

Array<int> BoundaryConditions::Dofs(ParFiniteElementSpace &space,
                                    const Array<int> &boundary, int component,
                                    Array<int> &all) const
{
   Array<int> dofs;
   space.GetEssentialTrueDofs(Marker(boundary), dofs, component);
   all.Append(dofs);
   all.Sort();
   all.Unique();
   return dofs;
}

void BoundaryConditions::PrescribeDisplacement(const Array<int> &boundary,
                                               int component,
                                               const LoadCurve &value)
{
   MFEM_VERIFY(component >= 0 && component < 3,
               "a displacement has the components 0, 1 and 2");
   u_values.push_back(
      {Dofs(spaces.Displacement(), boundary, component, u_dofs), value});
   AddCorners(value);
}

void BoundaryConditions::PrescribeIncrement(const Array<int> &boundary,
                                            int component,
                                            const LoadCurve &value,
                                            real_t since)
{
   MFEM_VERIFY(component >= 0 && component < 3,
               "a displacement has the components 0, 1 and 2");
   const Array<int> dofs =
      Dofs(spaces.Displacement(), boundary, component, u_dofs);
   Vector origin(dofs.Size());
   origin = 0.0;
   increments.push_back({dofs, value, since, origin});
   AddCorners(value);
}

void BoundaryConditions::PrescribeDisplacement(const Array<int> &boundary,
                                               VectorCoefficient &value)
{
   u_fields.push_back({Dofs(spaces.Displacement(), boundary, -1, u_dofs),
                       Marker(boundary), &value, nullptr});
}

void BoundaryConditions::PrescribePressure(const Array<int> &boundary,
                                           const LoadCurve &value)
{
   p_values.push_back({Dofs(spaces.Pressure(), boundary, -1, p_dofs), value});
   AddCorners(value);
}

void BoundaryConditions::PrescribePressure(const Array<int> &boundary,
                                           Coefficient &value)
{
   p_fields.push_back({Dofs(spaces.Pressure(), boundary, -1, p_dofs),
                       Marker(boundary), nullptr, &value});
}

void BoundaryConditions::HoldDryPressures(const Array<int> &dofs)
{
   dry_dofs = dofs;
   p_dofs.Append(dofs);
   p_dofs.Sort();
   p_dofs.Unique();
}

void BoundaryConditions::AddTraction(const Array<int> &boundary,
                                     const Vector &direction,
                                     const LoadCurve &value)
{
   VectorConstantCoefficient coefficient(direction);
   Array<int> marker = Marker(boundary);
   ParLinearForm form(&spaces.Displacement());
   form.AddBoundaryIntegrator(new VectorBoundaryLFIntegrator(coefficient),
                              marker);
   momentum_loads.push_back({Vector(), value});
   AssembleInto(form, momentum_loads.back().load);
   AddCorners(value);
}

void BoundaryConditions::AddNormalTraction(const Array<int> &boundary,
                                           const LoadCurve &value)
{
   AddCorners(value);
   Array<int> marker = Marker(boundary);
   if (deformation == Deformation::finite)
   {
      followers.AddTraction(marker, value);
      return;
   }
   ConstantCoefficient one(1.0);
   ParLinearForm form(&spaces.Displacement());
   form.AddBoundaryIntegrator(new VectorBoundaryFluxLFIntegrator(one), marker);
   momentum_loads.push_back({Vector(), value});
   AssembleInto(form, momentum_loads.back().load);
}

void BoundaryConditions::AddEffectiveTraction(const Array<int> &boundary,
                                              const LoadCurve &value)
{
   if (deformation != Deformation::finite)
   {
      throw Error("an effective traction is only known in finite deformation; "
                  "give the total one");
   }
   AddCorners(value);
   followers.AddEffectiveTraction(Marker(boundary), value);
}

void BoundaryConditions::AddSprings(const Array<int> &boundary,
                                    real_t stiffness, const Vector &direction)
{
   springs.emplace_back(spaces, boundary, stiffness, direction);
}

void BoundaryConditions::DriveByForce(const Array<int> &boundary,
                                      const Vector &direction,
                                      const LoadCurve &force,
                                      const std::string &name)
{
   Vector unit(direction);
   const real_t length = unit.Norml2();
   if (unit.Size() != 3 || !(length > 0.0))
   {
      throw Error("the direction of a force is zero; give a vector");
   }
   unit /= length;
   driven.push_back({name, boundary, {{unit[0], unit[1], unit[2]}}, force});
   AddCorners(force);
}

void BoundaryConditions::AddRigidBody(const RigidBody &body)
{
   const RigidBodyOptions &options = body.options;
   const std::string problem = Contradiction(options, deformation);
   if (!problem.empty())
   {
      throw Error("the rigid body \"" + body.name + "\": " + problem);
   }
   rigid_bodies.push_back(body);
   for (int i = 0; i < 6; i++)
   {
      AddCorners(options.IsFree(i) ? options.load[i] : *options.prescribed[i]);
   }
}

std::vector<std::string> BoundaryConditions::RigidBodyNames() const
{
   std::vector<std::string> names;
   for (const RigidBody &body : rigid_bodies)
   {
      names.push_back(body.name);
   }
   return names;
}

void BoundaryConditions::AddJoint(const Joint &joint)
{
   const std::string problem = Contradiction(joint, RigidBodyNames());
   if (!problem.empty())
   {
      throw Error("the joint \"" + joint.name + "\": " + problem);
   }
   joints.push_back(joint);
   for (const std::optional<LoadCurve> &curve : joint.prescribed)
   {
      if (curve)
      {
         AddCorners(*curve);
      }
   }
}

void BoundaryConditions::AddLigament(const Ligament &ligament)
{
   const std::string problem = Contradiction(ligament, RigidBodyNames());
   if (!problem.empty())
   {
      throw Error("the ligament \"" + ligament.name + "\": " + problem);
   }
   ligaments.push_back(ligament);
}

void BoundaryConditions::Seal(const Array<int> &boundary)
{
   sealed.Append(boundary);
}

void BoundaryConditions::AddNormalFlux(const Array<int> &boundary,
                                       const LoadCurve &value)
{
   AddCorners(value);
   Array<int> marker = Marker(boundary);
   if (deformation == Deformation::finite)
   {
      followers.AddFlux(marker, value);
      return;
   }
   ConstantCoefficient outflow(-1.0);
   ParLinearForm form(&spaces.Pressure());
   form.AddBoundaryIntegrator(new BoundaryLFIntegrator(outflow), marker);
   mass_loads.push_back({Vector(), value});
   AssembleInto(form, mass_loads.back().load);
}

void BoundaryConditions::AddMixtureFlux(const Array<int> &boundary,
                                        const LoadCurve &value)
{
   if (deformation != Deformation::finite)
   {
      throw Error("a flux of the mixture is only known in finite deformation; "
                  "give the relative one");
   }
   AddCorners(value);
   followers.AddMixtureFlux(Marker(boundary), value);
}

BoundaryConditions::FieldLoad &BoundaryConditions::MomentumForm()
{
   if (!momentum_form.form)
   {
      momentum_form.form =
         std::make_unique<ParLinearForm>(&spaces.Displacement());
   }
   return momentum_form;
}

BoundaryConditions::FieldLoad &BoundaryConditions::MassForm()
{
   if (!mass_form.form)
   {
      mass_form.form = std::make_unique<ParLinearForm>(&spaces.Pressure());
   }
   return mass_form;
}

void BoundaryConditions::AddTraction(const Array<int> &boundary,
                                     VectorCoefficient &value)
{
   FieldLoad &load = MomentumForm();
   load.markers.push_back(std::make_unique<Array<int>>(Marker(boundary)));
   load.form->AddBoundaryIntegrator(new VectorBoundaryLFIntegrator(value),
                                    *load.markers.back());
   load.vectors.push_back(&value);
}

void BoundaryConditions::AddNormalFlux(const Array<int> &boundary,
                                       Coefficient &value)
{
   FieldLoad &load = MassForm();
   load.markers.push_back(std::make_unique<Array<int>>(Marker(boundary)));
   load.own_scalars.push_back(
      std::make_unique<ProductCoefficient>(-1.0, value));
   load.form->AddBoundaryIntegrator(
      new BoundaryLFIntegrator(*load.own_scalars.back()), *load.markers.back());
   load.scalars.push_back(&value);
}

void BoundaryConditions::AddBodyForce(VectorCoefficient &value)
{
   FieldLoad &load = MomentumForm();
   load.form->AddDomainIntegrator(new VectorDomainLFIntegrator(value));
   load.vectors.push_back(&value);
}

void BoundaryConditions::AddFluidSource(Coefficient &value)
{
   FieldLoad &load = MassForm();
   load.form->AddDomainIntegrator(new DomainLFIntegrator(value));
   load.scalars.push_back(&value);
}

void BoundaryConditions::AddLoads(const Vector &forces, const Vector &inflow,
                                  const LoadCurve &curve)
{
   momentum_loads.push_back({forces, curve});
   mass_loads.push_back({inflow, curve});
   AddCorners(curve);
}

void BoundaryConditions::SetOrigins(real_t t, const Vector &u)
{
   for (Increment &increment : increments)
   {
      if (increment.since == t)
      {
         u.GetSubVector(increment.dofs, increment.origin);
      }
   }
}

void BoundaryConditions::Archive(StateArchive &archive)
{
   if (increments.empty())
   {
      return;
   }
   Vector origins(spaces.Displacement().GetTrueVSize());
   origins = 0.0;
   for (const Increment &increment : increments)
   {
      origins.SetSubVector(increment.dofs, increment.origin);
   }
   archive.Field("origin.displacement", spaces.Displacement(), origins);
   if (archive.Reads())
   {
      for (Increment &increment : increments)
      {
         origins.GetSubVector(increment.dofs, increment.origin);
      }
   }
}

void BoundaryConditions::SetDisplacement(real_t t, Vector &u)
{
   for (const CurveValue &value : u_values)
   {
      u.SetSubVector(value.dofs, value.curve(t));
   }
   for (const Increment &increment : increments)
   {
      const real_t value = increment.curve(t);
      for (int i = 0; i < increment.dofs.Size(); i++)
      {
         u[increment.dofs[i]] = increment.origin[i] + value;
      }
   }
   for (FieldValue &value : u_fields)
   {
      ParGridFunction field(&spaces.Displacement());
      field = 0.0;
      value.vector->SetTime(t);
      field.ProjectBdrCoefficient(*value.vector, value.marker);
      Vector true_dofs;
      field.GetTrueDofs(true_dofs);
      true_dofs.HostRead();
      for (const int dof : value.dofs)
      {
         u[dof] = true_dofs[dof];
      }
   }
}

void BoundaryConditions::SetPressure(real_t t, Vector &p)
{
   for (const CurveValue &value : p_values)
   {
      p.SetSubVector(value.dofs, value.curve(t));
   }
   for (FieldValue &value : p_fields)
   {
      ParGridFunction field(&spaces.Pressure());
      field = 0.0;
      value.scalar->SetTime(t);
      field.ProjectBdrCoefficient(*value.scalar, value.marker);
      Vector true_dofs;
      field.GetTrueDofs(true_dofs);
      true_dofs.HostRead();
      for (const int dof : value.dofs)
      {
         p[dof] = true_dofs[dof];
      }
   }
   p.SetSubVector(dry_dofs, 0.0);
}

void BoundaryConditions::FieldLoad::AddTo(real_t t, Vector &load)
{
   if (!form)
   {
      return;
   }
   for (VectorCoefficient *coefficient : vectors)
   {
      coefficient->SetTime(t);
   }
   for (Coefficient *coefficient : scalars)
   {
      coefficient->SetTime(t);
   }
   Vector assembled;
   AssembleInto(*form, assembled);
   load += assembled;
}

void BoundaryConditions::GetLoads(real_t t, Vector &momentum, Vector &mass)
{
   momentum.SetSize(spaces.Displacement().GetTrueVSize());
   mass.SetSize(spaces.Pressure().GetTrueVSize());
   momentum = 0.0;
   mass = 0.0;
   for (const CurveLoad &load : momentum_loads)
   {
      momentum.Add(load.curve(t), load.load);
   }
   for (const CurveLoad &load : mass_loads)
   {
      mass.Add(load.curve(t), load.load);
   }
   momentum_form.AddTo(t, momentum);
   mass_form.AddTo(t, mass);
}

} // namespace synovia
