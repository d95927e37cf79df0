#include "synovia/io/paraview_output.hpp"
#include "synovia/general/error.hpp"
#include "synovia/io/output_directory.hpp"
#include "synovia/io/vtu_piece.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace synovia
{

using namespace mfem;

namespace
{
// More than a file that names the others has.
constexpr std::size_t probe_size = 1 << 20;

/// Whether a file ends like a whole VTK file. MFEM does not look at the state
/// of its streams, and a full disk leaves files that ParaView can't read.
bool IsWhole(const std::string &path)
{
   constexpr int tail = 32;
   std::ifstream file(path, std::ios::binary | std::ios::ate);
   const std::streamoff size = file ? std::streamoff(file.tellg()) : 0;
   std::string end(
      static_cast<std::size_t>(std::min<std::streamoff>(size, tail)), ' ');
   file.seekg(size - static_cast<std::streamoff>(end.size()));
   file.read(end.data(), static_cast<std::streamsize>(end.size()));
   return file && end.find("</VTKFile>") != std::string::npos;
}

/// Another mesh in the place of one, as long as it lives.
class ReplacedMesh
{
public:
   ReplacedMesh(Mesh *&place_, Mesh *other) : place(place_), own(place_)
   {
      place = other;
   }
   ~ReplacedMesh() { place = own; }
   ReplacedMesh(const ReplacedMesh &) = delete;
   ReplacedMesh &operator=(const ReplacedMesh &) = delete;

private:
   Mesh *&place;
   Mesh *const own;
};
} // namespace

/// MFEM's collection, which keeps the names of its files to itself. It writes
/// the files that name the others; what a rank has of the mesh is written here.
class ParaViewOutput::Collection : public ParaViewDataCollection
{
public:
   Collection(const std::string &name, ParMesh &mesh_, int order)
      : ParaViewDataCollection(name, &mesh_), piece(mesh_, order)
   {
   }

   void Save() override
   {
      // Pieces without elements take MFEM no time.
      {
         Mesh nothing;
         const ReplacedMesh replaced(mesh, &nothing);
         ParaViewDataCollection::Save();
      }
      VtuPiece::Fields fields;
      for (const auto &[name, field] : GetFieldMap())
      {
         fields.emplace_back(name, static_cast<ParGridFunction *>(field));
      }
      errno = 0;
      std::ofstream file(PiecePath());
      piece.Write(file, fields);
      file.close();
      piece_fault = file ? "" : std::strerror(errno);
   }

   /// What is wrong with the files of the last Save(), or nothing.
   std::string Fault()
   {
      const std::string root = GenerateCollectionPath();
      const std::string cycle_path = root + "/" + GenerateVTUPath() + "/";
      std::vector<std::string> files = {PiecePath()};
      if (myid == 0)
      {
         files.push_back(cycle_path + GeneratePVTUFileName("data"));
         files.push_back(root + "/" + GeneratePVDFileName());
      }
      for (const std::string &file : files)
      {
         if (!IsWhole(file))
         {
            const std::string subject = "'" + file + "'";
            const std::string why = ProbeForWriting(root, probe_size, subject);
            if (!why.empty())
            {
               return why;
            }
            return "cannot write " + subject + ": " +
                   (file == PiecePath() && !piece_fault.empty()
                       ? piece_fault
                       : "it is missing or cut short");
         }
      }
      return "";
   }

private:
   std::string PiecePath()
   {
      return GenerateCollectionPath() + "/" + GenerateVTUPath() + "/" +
             GenerateVTUFileName("proc", myid);
   }

   VtuPiece piece;
   std::string piece_fault;
};

ParaViewOutput::ParaViewOutput(const std::string &directory,
                               const std::string &name, ParMesh &mesh,
                               int order, bool append)
   : comm(mesh.GetComm())
{
   MakeOutputDirectory(directory + "/" + name, comm);
   collection = std::make_unique<Collection>(name, mesh, std::max(1, order));
   collection->SetPrefixPath(directory);
   collection->SetHighOrderOutput(true);
   collection->SetDataFormat(VTKFormat::BINARY);
   collection->SetCompressionLevel(-1);
   collection->UseRestartMode(append);
}

ParaViewOutput::~ParaViewOutput() = default;

void ParaViewOutput::Register(const std::string &field, ParGridFunction &values)
{
   collection->RegisterField(field, &values);
}

void ParaViewOutput::Save(int cycle, real_t time)
{
   collection->SetCycle(cycle);
   collection->SetTime(time);
   collection->Save();
   ThrowIfAny(comm, collection->Fault());
}

} // namespace synovia
