#pragma once

#include "mfem.hpp"

#include <memory>
#include <string>

namespace synovia
{

/// Time series of fields on a mesh for ParaView, in files
/// `<directory>/<name>/<name>.pvd` and below.
///
/// Binary, compressed, with curved elements and fields of high order. Fields on
/// a surface go to a ParaViewOutput of their own with the ParSubMesh that was
/// made from the boundary as its mesh.
class ParaViewOutput
{
public:
   /// Borrows @a mesh. @a order is the order of the written elements; with the
   /// highest order of the fields nothing is lost. Collective. Throws Error if
   /// the directory can't be made or written into. @a append keeps the steps of
   /// an earlier run that lie before the first one saved here.
   ParaViewOutput(const std::string &directory, const std::string &name,
                  mfem::ParMesh &mesh, int order, bool append = false);
   ~ParaViewOutput();

   /// Saves this field from now on, under this name. Borrows it. It must be
   /// continuous. Six components are stresses: xx, yy, zz, xy, yz, xz, as
   /// ParaView has them.
   void Register(const std::string &field, mfem::ParGridFunction &values);

   /// Writes the fields as they are. Cycles are numbers of files, and ascend.
   /// Collective. Throws Error on all ranks if a file can't be written or is
   /// not whole, for one because the disk is full.
   void Save(int cycle, mfem::real_t time);

private:
   class Collection;

   MPI_Comm comm;
   std::unique_ptr<Collection> collection;
};

} // namespace synovia
