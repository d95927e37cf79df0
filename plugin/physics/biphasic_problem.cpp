#include "synovia/physics/biphasic_problem.hpp"
#include "synovia/fem/dry_pressures.hpp"
#include "synovia/fem/law_checks.hpp"
#include "synovia/fem/linear_body_form.hpp"
#include "synovia/fem/total_lagrangian_form.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/mesh/boundary_marker.hpp"
#include "synovia/mesh/named_boundaries.hpp"
#include "synovia/mesh/region_boundaries.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
real_t AreaOf(ElementTransformation &trans)
{
   const IntegrationRule &rule =
      IntRules.Get(trans.GetGeometryType(), trans.OrderW() + 2);
   real_t area = 0.0;
   for (const IntegrationPoint &point : rule)
   {
      trans.SetIntPoint(&point);
      area += point.weight * trans.Weight();
   }
   return area;
}
} // namespace

BiphasicProblem::BiphasicProblem(NamedMesh &mesh_, const SpaceOptions &options)
   : mesh(mesh_), deformation(options.deformation),
     spaces(mesh.Get(), options.order, options.stabilization),
     conditions(std::make_unique<BoundaryConditions>(spaces, deformation))
{
}

void BiphasicProblem::VerifyOpen() const
{
   MFEM_VERIFY(!op, "the problem has been assembled; set it up before");
}

void BiphasicProblem::SetMaterial(const std::string &region,
                                  const SolidLaw &solid,
                                  const PermeabilityLaw &permeability,
                                  real_t solid_fraction)
{
   SetMaterial(region, {&solid, &permeability, solid_fraction});
}

void BiphasicProblem::SetMaterial(const std::string &region,
                                  const SolidLaw &solid)
{
   Material material;
   material.solid = &solid;
   SetMaterial(region, material);
}

void BiphasicProblem::SetMaterial(const std::string &region,
                                  const Material &material)
{
   VerifyOpen();
   if (material.mean_dilatation && spaces.Order() > 1)
   {
      throw Error("region \"" + region +
                  "\": mean_dilatation is for displacements of order 1; those "
                  "of order " +
                  std::to_string(spaces.Order()) + " don't need it");
   }
   materials.Set(mesh.Region(region), material);
}

void BiphasicProblem::SetAcceleration(
   const std::array<LoadCurve, 3> &acceleration_)
{
   VerifyOpen();
   acceleration = acceleration_;
}

Point3 BiphasicProblem::Acceleration(real_t t) const
{
   Point3 now{{0.0, 0.0, 0.0}};
   for (int d = 0; d < 3 && acceleration; d++)
   {
      now[d] = (*acceleration)[d](t);
   }
   return now;
}

void BiphasicProblem::AddGravity()
{
   if (!acceleration)
   {
      return;
   }
   if (deformation == Deformation::finite)
   {
      gravity =
         std::make_unique<GravityLoads>(spaces, materials, *acceleration);
   }
   for (int d = 0; d < 3; d++)
   {
      if (deformation == Deformation::finite)
      {
         conditions->AddCorners((*acceleration)[d]);
         continue;
      }
      Vector forces;
      Vector inflow;
      AssembleGravity(spaces, materials, d, forces, inflow);
      conditions->AddLoads(forces, inflow, (*acceleration)[d]);
   }
}

BiphasicProblem::Support &
BiphasicProblem::SupportOf(const std::string &boundary)
{
   for (Support &support : supports)
   {
      if (support.boundary == boundary)
      {
         return support;
      }
   }
   supports.emplace_back();
   supports.back().boundary = boundary;
   return supports.back();
}

void BiphasicProblem::FixDisplacement(const std::string &boundary)
{
   for (int d = 0; d < 3; d++)
   {
      PrescribeDisplacement(boundary, d, 0.0);
   }
}

void BiphasicProblem::PrescribeDisplacement(const std::string &boundary,
                                            int component,
                                            const LoadCurve &value)
{
   VerifyOpen();
   conditions->PrescribeDisplacement(mesh.Boundary(boundary), component, value);
   SupportOf(boundary).components[component] = true;
}

void BiphasicProblem::PrescribeIncrement(const std::string &boundary,
                                         int component, const LoadCurve &value,
                                         real_t since)
{
   VerifyOpen();
   conditions->PrescribeIncrement(mesh.Boundary(boundary), component, value,
                                  since);
   SupportOf(boundary).components[component] = true;
}

void BiphasicProblem::PrescribePressure(const std::string &boundary,
                                        const LoadCurve &value)
{
   VerifyOpen();
   NeedFluid(boundary);
   conditions->PrescribePressure(mesh.Boundary(boundary), value);
}

void BiphasicProblem::AddTraction(const std::string &boundary,
                                  const Vector &direction,
                                  const LoadCurve &value)
{
   VerifyOpen();
   conditions->AddTraction(mesh.Boundary(boundary), direction, value);
}

void BiphasicProblem::AddNormalTraction(const std::string &boundary,
                                        const LoadCurve &value)
{
   VerifyOpen();
   conditions->AddNormalTraction(mesh.Boundary(boundary), value);
}

void BiphasicProblem::AddEffectiveTraction(const std::string &boundary,
                                           const LoadCurve &value)
{
   VerifyOpen();
   conditions->AddEffectiveTraction(mesh.Boundary(boundary), value);
}

void BiphasicProblem::AddNormalFlux(const std::string &boundary,
                                    const LoadCurve &value)
{
   VerifyOpen();
   NeedFluid(boundary);
   conditions->AddNormalFlux(mesh.Boundary(boundary), value);
}

void BiphasicProblem::Seal(const std::string &boundary)
{
   VerifyOpen();
   NeedFluid(boundary);
   conditions->Seal(mesh.Boundary(boundary));
}

void BiphasicProblem::AddMixtureFlux(const std::string &boundary,
                                     const LoadCurve &value)
{
   VerifyOpen();
   NeedFluid(boundary);
   conditions->AddMixtureFlux(mesh.Boundary(boundary), value);
}

void BiphasicProblem::AddSprings(const std::vector<std::string> &boundaries,
                                 real_t stiffness, const Vector &direction)
{
   VerifyOpen();
   conditions->AddSprings(Boundaries(boundaries), stiffness, direction);
   spring_names.push_back(boundaries.front());
}

void BiphasicProblem::AddGuide(const std::vector<std::string> &boundaries,
                               const Point3 &direction)
{
   constexpr real_t stiffer = 1e6;
   ParMesh &bodies = mesh.Get();
   const Array<int> attributes = Boundaries(boundaries);
   real_t area = 0.0;
   real_t modulus = 0.0;
   for (int b = 0; b < bodies.GetNBE(); b++)
   {
      if (attributes.Find(bodies.GetBdrAttribute(b)) < 0)
      {
         continue;
      }
      area += AreaOf(*bodies.GetBdrElementTransformation(b));
      int element = 0;
      int info = 0;
      bodies.GetBdrElementAdjacentElement(b, element, info);
      const Material &material = materials.Get(bodies.GetAttribute(element));
      if (!material.IsRigid())
      {
         modulus = std::max(modulus, material.solid->AggregateModulus());
      }
   }
   area = SumOverRanks(area, mesh.GetComm());
   modulus = MaxOverRanks(modulus, mesh.GetComm());
   AddSprings(boundaries, stiffer * modulus * std::sqrt(area),
              Vector({direction[0], direction[1], direction[2]}));
}

void BiphasicProblem::DriveByForce(const std::vector<std::string> &boundaries,
                                   const Vector &direction,
                                   const LoadCurve &force)
{
   VerifyOpen();
   conditions->DriveByForce(Boundaries(boundaries), direction, force,
                            boundaries.front());
   for (const std::string &boundary : boundaries)
   {
      for (int d = 0; d < 3; d++)
      {
         SupportOf(boundary).components[d] |= direction[d] != 0.0;
      }
   }
}

void BiphasicProblem::AddRigidBody(const std::string &name,
                                   const std::vector<std::string> &boundaries,
                                   const RigidBodyOptions &options,
                                   const std::vector<std::string> &regions)
{
   VerifyOpen();
   RigidBody body{name, Boundaries(boundaries), options};
   for (const std::string &region : regions)
   {
      const Array<int> attributes = mesh.Region(region);
      materials.Set(attributes, Material());
      body.regions.Append(attributes);
   }
   body.boundary.Append(BoundariesOnlyOf(mesh.Get(), body.regions));
   body.boundary.Sort();
   body.boundary.Unique();
   conditions->AddRigidBody(body);
}

void BiphasicProblem::AddLigament(const Ligament &ligament)
{
   VerifyOpen();
   conditions->AddLigament(ligament);
}

void BiphasicProblem::AddJoint(const Joint &joint)
{
   VerifyOpen();
   conditions->AddJoint(joint);
}

void BiphasicProblem::AddContact(const std::string &source,
                                 const std::string &destination,
                                 const ContactOptions &options,
                                 const std::string &name)
{
   AddContact(std::vector<std::string>{source},
              std::vector<std::string>{destination}, options, name);
}

void BiphasicProblem::AddContact(const std::vector<std::string> &sources,
                                 const std::vector<std::string> &destinations,
                                 const ContactOptions &options,
                                 const std::string &name)
{
   VerifyOpen();
   MFEM_VERIFY(!sources.empty() && !destinations.empty(),
               "each side of a contact pair needs a boundary");
   pair_setups.push_back(
      {Boundaries(sources), Boundaries(destinations), options,
       name.empty() ? sources.front() + "-" + destinations.front() : name});
}

void BiphasicProblem::AddTie(const std::vector<std::string> &sources,
                             const std::vector<std::string> &destinations,
                             const TieOptions &options, const std::string &name)
{
   VerifyOpen();
   MFEM_VERIFY(!sources.empty() && !destinations.empty(),
               "each side of a tie needs a boundary");
   tie_setups.push_back(
      {Boundaries(sources), Boundaries(destinations), options,
       name.empty() ? sources.front() + "-" + destinations.front() : name});
}

void BiphasicProblem::VerifyTies() const
{
   for (const TieSetup &tie : tie_setups)
   {
      for (const PairSetup &pair : pair_setups)
      {
         for (const Array<int> *touching : {&pair.source, &pair.destination})
         {
            for (const int surface : *touching)
            {
               if (tie.source.Find(surface) >= 0 ||
                   tie.destination.Find(surface) >= 0)
               {
                  throw Error("tie \"" + tie.name + "\": \"" +
                              NameOf(mesh.Boundaries(), surface) +
                              "\" is in the contact pair \"" + pair.name +
                              "\" as well; a surface is tied or may touch");
               }
            }
         }
      }
   }
}

std::vector<Body> BiphasicProblem::Bodies()
{
   std::vector<Array<int>> tied;
   for (const TieSetup &tie : tie_setups)
   {
      tied.push_back(tie.source);
      tied.back().Append(tie.destination);
   }
   return JoinBodies(FindBodies(mesh, spaces), tied);
}

Array<int>
BiphasicProblem::Boundaries(const std::vector<std::string> &names) const
{
   return NamedBoundaries(mesh, names);
}

void BiphasicProblem::SetNonlinearOptions(const NonlinearOptions &options)
{
   VerifyOpen();
   nonlinear = options;
}

void BiphasicProblem::NeedFluid(const std::string &boundary)
{
   with_fluid.insert(boundary);
}

void BiphasicProblem::VerifyFluid()
{
   const Array<int> wet =
      BoundariesOf(mesh.Get(), materials.WithFluid(mesh.Get().attributes));
   for (const std::string &name : with_fluid)
   {
      const Array<int> boundary = mesh.Boundary(name);
      if (std::none_of(boundary.begin(), boundary.end(),
                       [&wet](int attribute)
                       { return wet.FindSorted(attribute) >= 0; }))
      {
         throw Error("a pressure or a flux of the fluid is prescribed on \"" +
                     name +
                     "\", but the body there has none; leave it out, or give "
                     "its material a permeability");
      }
   }
}

void BiphasicProblem::VerifyMaterials()
{
   std::string missing;
   for (const int attribute : mesh.Get().attributes)
   {
      if (materials.Has(attribute))
      {
         continue;
      }
      std::string name = std::to_string(attribute);
      for (const auto &[region, attributes] : mesh.Regions())
      {
         if (std::find(attributes.begin(), attributes.end(), attribute) !=
             attributes.end())
         {
            name = "\"" + region + "\"";
         }
      }
      missing += (missing.empty() ? "" : ", ") + name;
   }
   if (!missing.empty())
   {
      throw Error("no material is set for: " + missing);
   }
   VerifyLaws(mesh, spaces, materials, deformation);
}

std::unique_ptr<BodyForm> BiphasicProblem::MakeBodies()
{
   if (deformation == Deformation::infinitesimal)
   {
      return std::make_unique<LinearBodyForm>(spaces, materials,
                                              conditions->Springs());
   }
   return std::make_unique<TotalLagrangianForm>(
      mesh, spaces, materials, conditions->Springs(), conditions->Followers(),
      ElementPoints::straight, gravity.get());
}

BiphasicOperator &BiphasicProblem::Operator()
{
   if (!op)
   {
      VerifyMaterials();
      VerifyFluid();
      AddGravity();
      conditions->HoldDryPressures(FindDryPressures(spaces, materials));
      std::vector<ContactPair *> borrowed;
      for (const PairSetup &setup : pair_setups)
      {
         pairs.push_back(std::make_unique<ContactPair>(
            setup.name, spaces, materials, setup.source, setup.destination,
            setup.options, deformation, nonlinear.tuning.contact));
         borrowed.push_back(pairs.back().get());
      }
      VerifyTies();
      std::vector<TiedInterface *> borrowed_ties;
      for (const TieSetup &setup : tie_setups)
      {
         interfaces.push_back(std::make_unique<TiedInterface>(
            setup.name, spaces, materials, setup.source, setup.destination,
            setup.options, nonlinear.tuning.contact));
         borrowed_ties.push_back(interfaces.back().get());
      }
      op = std::make_unique<BiphasicOperator>(
         spaces, Bodies(), [this] { return MakeBodies(); }, *conditions,
         borrowed, borrowed_ties, nonlinear);
   }
   return *op;
}

Point3 BiphasicProblem::Reaction(const Support &support)
{
   const real_t *forces = Operator().Balance().support.HostRead();
   const Array<int> marker =
      BoundaryMarker(mesh.Get(), mesh.Boundary(support.boundary));
   Point3 reaction{{0.0, 0.0, 0.0}};
   for (int d = 0; d < 3; d++)
   {
      if (support.components[d])
      {
         Array<int> dofs;
         spaces.Displacement().GetEssentialTrueDofs(marker, dofs, d);
         for (const int dof : dofs)
         {
            reaction[d] += forces[dof];
         }
      }
   }
   MPI_Allreduce(MPI_IN_PLACE, reaction.data(), 3, MPITypeMap<real_t>::mpi_type,
                 MPI_SUM, mesh.GetComm());
   return reaction;
}

std::vector<BiphasicProblem::RigidBodyState> BiphasicProblem::RigidBodyStates()
{
   const RigidTies &ties = Operator().Equations().Ties();
   const RigidPoses &poses = Operator().Poses();
   const std::vector<TiedForces> sums =
      SumForces(ties, poses, Operator().Balance().support);
   std::vector<RigidBodyState> states;
   for (int b = 0; b < ties.Bodies(); b++)
   {
      states.push_back({ties.Name(b), poses[b], sums[b].force, sums[b].moment});
   }
   return states;
}

std::vector<BiphasicProblem::LigamentState> BiphasicProblem::LigamentStates()
{
   const Ligaments &ligaments = Operator().Equations().Ligaments();
   std::vector<LigamentState> states;
   for (const Ligaments::State &state : ligaments.States(Operator().Poses()))
   {
      const int i = static_cast<int>(states.size());
      states.push_back({ligaments.Name(i), state.length, state.force});
   }
   return states;
}

std::vector<BiphasicProblem::JointState> BiphasicProblem::JointStates()
{
   const Joints &joints = Operator().Equations().Joints();
   std::vector<JointState> states;
   for (const Joints::State &state : joints.States(Operator().Poses()))
   {
      const int joint = static_cast<int>(states.size());
      states.push_back({state, joints.Name(joint), {}});
      for (int k = 0; k < 6; k++)
      {
         states.back().prescribed[k] = joints.IsPrescribed(joint, k);
      }
   }
   return states;
}

} // namespace synovia
