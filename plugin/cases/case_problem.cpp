#include "synovia/cases/case_problem.hpp"
#include "synovia/cases/key_names.hpp"
#include "synovia/fem/body.hpp"
#include "synovia/materials/field_frame.hpp"
#include "synovia/materials/law_registry.hpp"
#include "synovia/materials/projected_frame.hpp"
#include "synovia/mesh/named_boundaries.hpp"
#include "synovia/mesh/region_boundaries.hpp"
#include "synovia/mesh/surface_center.hpp"

#include <map>

namespace synovia
{

using namespace mfem;

Array<int> HeldSurfaces(const CaseFile &setup, const NamedMesh &mesh,
                        int component)
{
   Array<int> held;
   for (const BoundaryCase &boundary : setup.boundaries)
   {
      if (boundary.Holds(component))
      {
         held.Append(NamedBoundaries(mesh, boundary.surfaces));
      }
   }
   return held;
}

Array<int> TiedSurfaces(const RigidBodyCase &body, const NamedMesh &mesh)
{
   Array<int> regions;
   for (const std::string &name : body.AllRegions())
   {
      regions.Append(mesh.Region(name));
   }
   Array<int> tied = NamedBoundaries(mesh, body.surfaces);
   tied.Append(BoundariesOnlyOf(mesh.Get(), regions));
   return tied;
}

Array<int> GluedSurfaces(const CaseFile &setup, const NamedMesh &mesh)
{
   Array<int> glued;
   for (const TieCase &tie : setup.ties)
   {
      glued.Append(NamedBoundaries(mesh, tie.source));
      glued.Append(NamedBoundaries(mesh, tie.destination));
   }
   return glued;
}

Array<int> ContactSurfaces(const CaseFile &setup, const NamedMesh &mesh)
{
   Array<int> touching;
   for (const ContactCase &contact : setup.contacts)
   {
      touching.Append(NamedBoundaries(mesh, contact.source));
      touching.Append(NamedBoundaries(mesh, contact.destination));
   }
   return touching;
}

namespace
{
// Attributes for the names, with an error for each that @a find doesn't know.
template <typename Find>
Array<int> FindAll(const std::vector<std::string> &names,
                   const std::string &path, CaseReading &reading, Find find)
{
   Array<int> all;
   for (size_t i = 0; i < names.size(); i++)
   {
      reading.Catch(path + "." + std::to_string(i),
                    [&]() { all.Append(find(names[i])); });
   }
   return all;
}

void CheckRegions(const CaseFile &setup, const NamedMesh &mesh,
                  CaseReading &reading)
{
   const auto find = [&](const std::string &name) { return mesh.Region(name); };
   std::map<int, std::string> given;
   for (size_t i = 0; i < setup.materials.size(); i++)
   {
      const std::string path = EntryPath("material", i, "regions");
      for (const int region :
           FindAll(setup.materials[i].regions, path, reading, find))
      {
         const auto [first, fresh] = given.emplace(region, path);
         if (!fresh)
         {
            reading.AddError(path,
                             "the region \"" + NameOf(mesh.Regions(), region) +
                                "\" has a material already (" +
                                WhereIs(reading.Places(), first->second) + ")");
         }
      }
      const FrameCase &frame = setup.materials[i].frame;
      if (frame.type == FrameType::field)
      {
         reading.Catch(EntryPath("material", i, "frame.name"),
                       [&]() { mesh.Vectors(frame.name); });
      }
   }
   for (size_t i = 0; i < setup.rigid_bodies.size(); i++)
   {
      const std::string path = EntryPath("rigid_body", i, "regions");
      for (const int region :
           FindAll(setup.rigid_bodies[i].AllRegions(), path, reading, find))
      {
         const auto [first, fresh] = given.emplace(region, path);
         reading.Require(fresh, path,
                         "the region \"" + NameOf(mesh.Regions(), region) +
                            "\" has a material or is part of a rigid body "
                            "already (" +
                            WhereIs(reading.Places(), first->second) + ")");
      }
   }
   for (const int region : mesh.Get().attributes)
   {
      if (!given.count(region) && !reading.Count())
      {
         reading.AddError("material", "the region \"" +
                                         NameOf(mesh.Regions(), region) +
                                         "\" has no material");
      }
   }
}

void CheckSurfaces(const CaseFile &setup, const NamedMesh &mesh,
                   CaseReading &reading)
{
   const auto check = [&](const std::vector<std::string> &names,
                          const std::string &list, size_t i,
                          const std::string &key)
   {
      FindAll(names, EntryPath(list, i, key), reading,
              [&](const std::string &name) { return mesh.Boundary(name); });
   };
   for (size_t i = 0; i < setup.materials.size(); i++)
   {
      check(setup.materials[i].frame.between, "material", i, "frame.between");
      check(setup.materials[i].frame.around, "material", i, "frame.around");
      check(setup.materials[i].frame.surfaces, "material", i, "frame.surfaces");
   }
   for (size_t i = 0; i < setup.boundaries.size(); i++)
   {
      check(setup.boundaries[i].surfaces, "boundary", i, "surfaces");
   }
   for (size_t i = 0; i < setup.rigid_bodies.size(); i++)
   {
      check(setup.rigid_bodies[i].surfaces, "rigid_body", i, "surfaces");
   }
   for (size_t i = 0; i < setup.contacts.size(); i++)
   {
      check(setup.contacts[i].source, "contact", i, "source");
      check(setup.contacts[i].destination, "contact", i, "destination");
   }
   for (size_t i = 0; i < setup.ties.size(); i++)
   {
      check(setup.ties[i].source, "tie", i, "source");
      check(setup.ties[i].destination, "tie", i, "destination");
   }
}

void CheckSupports(const CaseFile &setup, const NamedMesh &mesh,
                   const std::vector<Body> &bodies, CaseReading &reading)
{
   const char *const axes[3] = {"x", "y", "z"};
   // Whether rigid bodies hold what is tied to them depends on all of it.
   Array<int> others = ContactSurfaces(setup, mesh);
   for (const RigidBodyCase &body : setup.rigid_bodies)
   {
      others.Append(TiedSurfaces(body, mesh));
   }
   const Array<int> held[3] = {HeldSurfaces(setup, mesh, 0),
                               HeldSurfaces(setup, mesh, 1),
                               HeldSurfaces(setup, mesh, 2)};
   for (const Body &body : bodies)
   {
      for (int d = 0; d < 3; d++)
      {
         if (!body.Touches(others) && !body.Touches(held[d]))
         {
            reading.AddError("boundary", "nothing holds \"" + body.name +
                                            "\" along " + axes[d] +
                                            "; prescribe that displacement on "
                                            "one of its surfaces");
         }
      }
   }
}

void CheckDirectLibrary(const CaseFile &setup, const NamedMesh &mesh,
                        CaseReading &reading)
{
   const DirectLibrary library = setup.solver.linear.direct.library;
   if (library != DirectLibrary::automatic)
   {
      reading.Catch("solver.direct",
                    [&]() { VerifyDirectLibrary(library, mesh.GetComm()); });
   }
}

NamedMesh &Verified(const CaseFile &setup, NamedMesh &mesh)
{
   CaseReading reading(setup.places);
   CheckDirectLibrary(setup, mesh, reading);
   CheckRegions(setup, mesh, reading);
   CheckSurfaces(setup, mesh, reading);
   reading.ThrowIfAny();
   return mesh;
}

Point3 FindOrigin(const FrameCase &frame, NamedMesh &mesh)
{
   if (!frame.around.empty())
   {
      return CenterOfCircle(mesh.Get(), NamedBoundaries(mesh, frame.around),
                            frame.axis);
   }
   if (frame.between.empty())
   {
      return frame.origin;
   }
   Point3 origin{{0.0, 0.0, 0.0}};
   for (const std::string &surface : frame.between)
   {
      origin = Sum(origin, 1.0 / frame.between.size(),
                   CenterOfArea(mesh.Get(), mesh.Boundary(surface)));
   }
   return origin;
}

std::unique_ptr<MaterialFrame> MakeFrame(const FrameCase &frame,
                                         NamedMesh &mesh)
{
   switch (frame.type)
   {
   case FrameType::cylindrical:
      return std::make_unique<CylindricalFrame>(FindOrigin(frame, mesh),
                                                frame.axis);
   case FrameType::field:
      return std::make_unique<FieldFrame>(mesh, frame.name);
   case FrameType::projected:
      return std::make_unique<ProjectedFrame>(
         mesh, NamedBoundaries(mesh, frame.surfaces), frame.direction);
   default:
      return std::make_unique<CartesianFrame>(frame.axis);
   }
}
} // namespace

CaseProblem::CaseProblem(const CaseFile &setup, NamedMesh &mesh)
   : problem(Verified(setup, mesh), setup.space)
{
   CaseReading reading(setup.places);
   for (const TieCase &tie : setup.ties)
   {
      problem.AddTie(tie.source, tie.destination, tie.options, tie.Name());
   }
   CheckSupports(setup, mesh, problem.Bodies(), reading);
   reading.ThrowIfAny();

   for (size_t i = 0; i < setup.materials.size(); i++)
   {
      reading.Catch("material." + std::to_string(i),
                    [&]() { SetMaterial(setup.materials[i]); });
   }
   for (size_t i = 0; i < setup.rigid_bodies.size(); i++)
   {
      const RigidBodyCase &body = setup.rigid_bodies[i];
      reading.Catch("rigid_body." + std::to_string(i),
                    [&]()
                    {
                       problem.AddRigidBody(body.name, body.surfaces,
                                            body.Options(), body.AllRegions());
                    });
   }
   reading.ThrowIfAny();
   reading.Catch("material", [&]() { problem.VerifyMaterials(); });
   reading.ThrowIfAny();
   if (setup.acceleration)
   {
      problem.SetAcceleration(*setup.acceleration);
   }
   for (const BoundaryCase &boundary : setup.boundaries)
   {
      SetBoundary(boundary);
   }
   reading.Catch("boundary", [&]() { problem.VerifyFluid(); });
   for (size_t i = 0; i < setup.ligaments.size(); i++)
   {
      reading.Catch("ligament." + std::to_string(i),
                    [&]() { problem.AddLigament(setup.ligaments[i]); });
   }
   for (size_t i = 0; i < setup.joints.size(); i++)
   {
      reading.Catch("joint." + std::to_string(i),
                    [&]() { problem.AddJoint(setup.joints[i]); });
   }
   CheckRigidBodies(setup, reading);
   reading.ThrowIfAny();
   for (const ContactCase &contact : setup.contacts)
   {
      problem.AddContact(contact.source, contact.destination, contact.options,
                         contact.Name());
   }
   problem.SetNonlinearOptions(setup.solver);
}

void CaseProblem::CheckRigidBodies(const CaseFile &setup, CaseReading &reading)
{
   if (setup.rigid_bodies.empty() || reading.Count() > 0)
   {
      return;
   }
   const BoundaryConditions &conditions = problem.Conditions();
   reading.Catch("rigid_body",
                 [&]()
                 {
                    const RigidTies ties(
                       problem.Spaces(), conditions.RigidBodies(),
                       conditions.DisplacementDofs(), problem.GetDeformation(),
                       conditions.Joints());
                    Joints(ties, conditions.Joints());
                 });
   if (setup.contacts.empty() && reading.Count() == 0)
   {
      const RigidFreedoms freedoms(problem.Bodies(), problem.Spaces(),
                                   conditions);
      const std::string loose = freedoms.ValidateSupports();
      reading.Require(loose.empty(), "rigid_body", loose);
   }
}

const SolidLaw &CaseProblem::AddSolid(const SolidCase &solid, LawArguments from)
{
   for (const SolidCase &part : solid.solids)
   {
      from.parts.push_back(
         &AddSolid(part, {{}, from.frame, from.solid_fraction, {}}));
   }
   const LawDescription *const law = SolidLaws().Find(solid.model);
   if (law && law->has_fibers)
   {
      const SolidCase fibers{solid.fibers.model, solid.fibers.parameters};
      from.parts.push_back(
         &AddSolid(fibers, {{}, from.frame, from.solid_fraction, {}}));
   }
   from.values = solid.parameters;
   from.vectors = solid.vectors;
   solids.push_back(SolidLaws().Make(solid.model, from));
   return *solids.back();
}

void CaseProblem::SetMaterial(const MaterialCase &material)
{
   frames.push_back(MakeFrame(material.frame, problem.Mesh()));
   LawArguments from{{}, *frames.back(), material.solid_fraction, {}};
   const SolidLaw &solid = AddSolid(material.solid, from);
   const PermeabilityLaw *permeability = nullptr;
   if (material.HasFluid())
   {
      from.values = material.permeability.parameters;
      permeabilities.push_back(
         PermeabilityLaws().Make(material.permeability.model, from));
      permeability = permeabilities.back().get();
   }
   for (const std::string &region : material.regions)
   {
      problem.SetMaterial(region,
                          {&solid, permeability, material.solid_fraction,
                           material.mean_dilatation, material.solid_density,
                           material.fluid_density, material.supply.Supply()});
   }
}

void CaseProblem::SetBoundary(const BoundaryCase &boundary)
{
   if (boundary.spring.stiffness > 0.0)
   {
      const auto &d = boundary.spring.direction;
      const Vector direction =
         boundary.spring.IsDirected() ? Vector({d[0], d[1], d[2]}) : Vector();
      problem.AddSprings(boundary.surfaces, boundary.spring.stiffness,
                         direction);
   }
   if (boundary.guide)
   {
      problem.AddGuide(boundary.surfaces, *boundary.guide);
   }
   if (boundary.force.curve)
   {
      const auto &d = boundary.force.direction;
      problem.DriveByForce(boundary.surfaces, Vector({d[0], d[1], d[2]}),
                           *boundary.force.curve);
   }
   for (const std::string &surface : boundary.surfaces)
   {
      for (int d = 0; d < 3; d++)
      {
         if (boundary.displacement[d] && boundary.relative)
         {
            problem.PrescribeIncrement(surface, d, *boundary.displacement[d],
                                       boundary.begin);
         }
         else if (boundary.displacement[d])
         {
            problem.PrescribeDisplacement(surface, d,
                                          *boundary.displacement[d]);
         }
         if (boundary.traction)
         {
            Vector direction(3);
            direction = 0.0;
            direction[d] = 1.0;
            problem.AddTraction(surface, direction, (*boundary.traction)[d]);
         }
      }
      if (boundary.pressure)
      {
         problem.PrescribePressure(surface, *boundary.pressure);
      }
      if (boundary.normal_traction)
      {
         problem.AddNormalTraction(surface, *boundary.normal_traction);
      }
      if (boundary.effective_traction)
      {
         problem.AddEffectiveTraction(surface, *boundary.effective_traction);
      }
      if (boundary.sealed)
      {
         problem.Seal(surface);
      }
      if (boundary.mixture_flux)
      {
         problem.AddMixtureFlux(surface, *boundary.mixture_flux);
      }
      if (boundary.normal_flux)
      {
         problem.AddNormalFlux(surface, *boundary.normal_flux);
      }
   }
}

} // namespace synovia
