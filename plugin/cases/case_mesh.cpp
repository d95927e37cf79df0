#include "synovia/cases/case_mesh.hpp"
#include "synovia/general/root_rank.hpp"

#include <filesystem>

namespace synovia
{

namespace
{
// The commands that make a missing mesh, if the case names its generator.
std::string MeshAdvice(const CaseFile &setup, MPI_Comm comm)
{
   const MeshGenerator &generator = setup.mesh.generator;
   if (generator.script.empty() ||
       OfRoot(std::filesystem::exists(setup.mesh.file), comm))
   {
      return "";
   }
   std::string command = "meshes/" + generator.script;
   for (const std::string &argument : generator.arguments)
   {
      command += " " + argument;
   }
   const auto file = setup.places.find("");
   return "; to make it and run the case: scripts/run " +
          (file == setup.places.end() ? "CASE.toml" : file->second.source) +
          "; to make it: scripts/run_python " + command + " -o " +
          setup.mesh.file;
}

} // namespace

NamedMesh ReadCaseMesh(const CaseFile &setup, MPI_Comm comm)
{
   try
   {
      ReadOptions options = setup.mesh.options;
      for (const ContactCase &contact : setup.contacts)
      {
         options.contacts.push_back({contact.source, contact.destination});
      }
      for (const RigidBodyCase &body : setup.rigid_bodies)
      {
         if (const std::optional<RigidShape> shape = body.Shape())
         {
            options.shapes.push_back(*shape);
         }
      }
      return ReadGmsh(setup.mesh.file, comm, options);
   }
   catch (const Error &error) // on all ranks alike
   {
      throw Error(WhereIs(setup.places, "mesh.file") + ": " + error.what() +
                  MeshAdvice(setup, comm));
   }
}

} // namespace synovia
