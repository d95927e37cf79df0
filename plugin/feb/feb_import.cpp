#include "synovia/feb/feb_import.hpp"
#include "synovia/cases/case_keys.hpp"
#include "synovia/feb/feb_conditions.hpp"
#include "synovia/feb/feb_rigid_parts.hpp"
#include "synovia/feb/feb_steady.hpp"
#include "synovia/feb/msh_writer.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/root_rank.hpp"
#include "synovia/general/text.hpp"
#include "synovia/io/output_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

namespace synovia
{

using namespace mfem;

namespace
{
namespace fs = std::filesystem;
using Fate = FebReport::Fate;

std::string ReadModule(const FebInput &root)
{
   const std::optional<FebInput> module = root.Find("Module");
   const std::string type = module ? module->Attribute("type") : "";
   if (module && type != "biphasic" && type != "solid")
   {
      module->Stop("the module \"" + type +
                   "\" is not known; there are biphasic and solid");
   }
   if (!module)
   {
      root.Stop("the section Module is missing");
   }
   return type;
}

// A section, or an empty one if it is missing.
template <typename Read>
void ForSection(const FebInput &root, const std::string &name, Read read)
{
   if (const std::optional<FebInput> section = root.Find(name))
   {
      read(*section);
   }
}

// Nodes that elements of a rigid material share with deformable ones are tied
// to the body.
void TieSharedNodes(const FebInput &root, const FebRigidMaterial &material,
                    FebModel &model, RigidBodyCase &body)
{
   std::set<int> shared;
   for (const FebPart &part : model.mesh.parts)
   {
      if (material.IsCalled(part.material))
      {
         for (const FebCell &cell : part.cells)
         {
            for (const int node : cell.nodes)
            {
               if (model.surfaces->IsUsed(node))
               {
                  shared.insert(node);
               }
            }
         }
      }
   }
   if (!shared.empty())
   {
      const std::string name = body.name + "_tied";
      model.mesh.node_sets[name].assign(shared.begin(), shared.end());
      const std::string surface = model.surfaces->OfNodes(name, root);
      if (!surface.empty())
      {
         body.surfaces.push_back(surface);
      }
   }
}

void AddRigidBodies(const FebInput &root, FebModel &model)
{
   for (const FebRigidMaterial &material : model.materials.rigid)
   {
      RigidBodyCase body;
      body.name = PlainName(material.name.empty() ? "rigid_" + material.number
                                                  : material.name);
      body.reference = material.center;
      for (const int part : material.parts)
      {
         if (model.touching.count(part) > 0)
         {
            body.regions.push_back(model.mesh.parts[part].name);
         }
      }
      if (body.regions.empty())
      {
         TieSharedNodes(root, material, model, body);
      }
      model.setup.rigid_bodies.push_back(body);
   }
}

void MakeSteady(const FebInput &root, FebModel &model)
{
   const real_t factor = MakeSteady(model);
   root.Find("Control")
      ->Find("analysis")
      ->Approximate("each step ends in a steady state, as permeabilities are "
                    "taken times " +
                    ToText(factor) + "; fluxes are too");
   for (const BoundaryCase &boundary : model.setup.boundaries)
   {
      if (boundary.normal_flux || boundary.mixture_flux)
      {
         root.Find("Loads")->Stop("prescribed fluxes are not known in steady "
                                  "states");
         return;
      }
   }
}

// 1 if all elements are linear, 2 if one of them isn't.
int Order(const FebMesh &mesh, const std::set<int> &parts)
{
   int order = 1;
   for (const int part : parts)
   {
      order = std::max(order, mesh.parts[part].shape->order);
   }
   return order;
}

// Those of the case's mesh.
std::set<int> Parts(const FebModel &model)
{
   std::set<int> parts(model.materials.deformable);
   parts.insert(model.touching.begin(), model.touching.end());
   return parts;
}

bool CanMove(const RigidBodyCase &body)
{
   const auto is_free = [](const std::optional<LoadCurve> &freedom)
   { return !freedom; };
   return std::any_of(body.translation.begin(), body.translation.end(),
                      is_free) ||
          std::any_of(body.rotation.begin(), body.rotation.end(), is_free);
}

// Body loads act on rigid bodies too.
void VerifyDensity(const FebRigidMaterial &material, const RigidBodyCase &body,
                   const FebModel &model)
{
   if (!model.setup.acceleration)
   {
      material.where.Ignore("density", "there is no inertia");
   }
   else if (material.density > 0.0 && CanMove(body))
   {
      material.where.Stop("body loads that act on rigid bodies are not known; "
                          "make its density 0, and its weight a rigid_force");
   }
}

// Leaves out bodies that only guide others.
void VerifyRigidBodies(FebModel &model)
{
   std::vector<RigidBodyCase> kept;
   for (size_t i = 0; i < model.setup.rigid_bodies.size(); i++)
   {
      const RigidBodyCase &body = model.setup.rigid_bodies[i];
      VerifyDensity(model.materials.rigid[i], body, model);
      if (!body.surfaces.empty() || !body.regions.empty())
      {
         kept.push_back(body);
      }
      else if (std::none_of(model.guides.begin(), model.guides.end(),
                            [i](const FebGuide &guide)
                            { return guide.body == static_cast<int>(i); }))
      {
         model.materials.rigid[i].where.Stop(
            "no nodes of a deformable solid are tied to this rigid body, and "
            "no contact has a surface of it");
      }
   }
   model.setup.rigid_bodies = kept;
}

void ReadModel(const FebInput &root, FebModel &model)
{
   model.module = ReadModule(root);
   ForSection(root, "LoadData",
              [&](const FebInput &section)
              { model.curves = ReadLoadData(section); });
   model.steps.ends = {1.0};
   model.steps.length = 1.0;
   ForSection(root, "Control",
              [&](const FebInput &section) {
                 model.steps = ReadControl(section, model.module, model.curves);
              });
   ReadStepTimes(root, model);
   for (const char *name : {"Mesh", "Geometry"})
   {
      ForSection(root, name,
                 [&](const FebInput &section)
                 { model.mesh = ReadFebMesh(section); });
   }
   ForSection(root, "MeshDomains",
              [&](const FebInput &section)
              { ReadMeshDomains(section, model.mesh); });
   const FebElementData data = ReadElementData(root, model.mesh);
   ForSection(root, "Material",
              [&](const FebInput &section)
              { model.materials = ReadMaterials(section, model.mesh, data); });
   model.guides = FindGuides(root, model.mesh, model.materials);
   model.touching = FindTouchingParts(model.mesh, model.materials);
   ThickenShells(model.touching, model.mesh);
   model.surfaces = std::make_unique<FebSurfaces>(
      model.mesh, model.materials.deformable, model.touching);
   model.setup.materials = model.materials.materials;
   AddRigidBodies(root, model);
   using Section = void (*)(const FebInput &, FebModel &);
   const std::pair<const char *, Section> sections[] = {
      {"Boundary", ReadBoundary}, {"Rigid", ReadRigid},
      {"Loads", ReadLoads},       {"Constraints", ReadConstraints},
      {"Contact", ReadContact},   {"Discrete", ReadDiscrete}};
   for (const auto &[name, read] : sections)
   {
      if (const std::optional<FebInput> section = root.Find(name))
      {
         read(*section, model);
      }
   }
   PutZerosFirst(model);
   ReadStepChanges(root, model);
   for (MaterialCase &material : model.setup.materials)
   {
      if (!model.setup.acceleration)
      {
         material.solid_density = 0.0;
         material.fluid_density = 0.0;
      }
   }
   VerifyRigidBodies(model);
}

std::string ReadFile(const std::string &file)
{
   std::ifstream in(file, std::ios::binary);
   std::stringstream text;
   text << in.rdbuf();
   if (!in || text.fail())
   {
      throw Error(file + ": cannot be read; is it there?");
   }
   return text.str();
}

// The case as TOML, headed by what is not as in the model.
std::string CaseText(FebImport &import, const std::string &source)
{
   std::ostringstream report;
   import.report.Print(source, report);
   std::ostringstream out;
   out << "# From " << source << '\n';
   std::istringstream lines(report.str());
   for (std::string line; std::getline(lines, line);)
   {
      out << "# " << line << '\n';
   }
   CaseKeys(import.setup).Write(out);
   return out.str();
}
} // namespace

bool IsFebFile(const std::string &file)
{
   return fs::path(file).extension() == ".feb";
}

FebImport ImportFeb(const std::string &text, const std::string &source)
{
   const FebElement element = ParseXml(text, source);
   if (element.name != "febio_spec")
   {
      throw Error(source + ":" + std::to_string(element.line) + ": found <" +
                  element.name + ">; a model of FEBio is in <febio_spec>");
   }
   FebImport import;
   const FebInput root(element, "", import.report);
   const std::string version = root.Attribute("version");
   if (version != "2.5" && version != "3.0" && version != "4.0")
   {
      throw Error(source + ":" + std::to_string(element.line) +
                  ": found the format version \"" + version +
                  "\"; there are 2.5, 3.0 and 4.0");
   }
   FebModel model;
   // FEBio has none.
   model.setup.space.stabilization = 0.0;
   ReadModel(root, model);
   ReadOutput(root, model);
   if (model.steps.steady && !import.report.IsStopped())
   {
      MakeSteady(root, model);
   }
   import.report.ListUnread(element);
   if (import.report.IsStopped())
   {
      return import;
   }
   import.setup = model.setup;
   const std::string name = fs::path(source).stem().string();
   import.setup.title = name;
   import.setup.mesh.file = name + ".msh";
   import.setup.space.deformation = Deformation::finite;
   import.setup.space.order = Order(model.mesh, model.materials.deformable);
   import.setup.time = model.steps.Options();
   import.setup.output.directory = "out/" + name;
   import.setup.output.fields_every = model.steps.fields_every;
   import.mesh = MshText(model.mesh, Parts(model), *model.surfaces,
                         model.materials.fields);
   return import;
}

std::string ConvertFeb(const std::string &file, const std::string &directory,
                       MPI_Comm comm)
{
   const std::string name = fs::path(file).stem().string();
   const std::string written =
      (fs::path(directory) / (name + ".toml")).string();
   OnRoot(comm,
          [&]()
          {
             FebImport import = ImportFeb(ReadFile(file), file);
             if (import.report.IsStopped())
             {
                std::ostringstream all;
                import.report.Print(file, all);
                throw Error(file + " can't be imported\n" + all.str());
             }
             import.report.Print(file, std::cout);
             std::error_code error;
             fs::create_directories(directory, error);
             if (error)
             {
                throw Error(directory + ": " + error.message());
             }
             ReplaceFile(
                (fs::path(directory) / import.setup.mesh.file).string(),
                import.mesh);
             ReplaceFile(written, CaseText(import, file));
          });
   return written;
}

} // namespace synovia
