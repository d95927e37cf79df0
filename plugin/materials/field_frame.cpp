#include "synovia/materials/field_frame.hpp"

namespace synovia
{

using namespace mfem;

FieldFrame::FieldFrame(const NamedMesh &mesh, const std::string &name_)
   : ElementFrame(mesh.Get().GetNE()), name(name_),
     numbers(mesh.Vectors(name).numbers)
{
   const std::vector<Point3> &vectors = mesh.Vectors(name).vectors;
   for (size_t i = 0; i < vectors.size(); i++)
   {
      if (Length(vectors[i]) > 0.0)
      {
         axes[i] = AxesAlong(vectors[i]);
      }
   }
}

std::string FieldFrame::Validate(ElementTransformation &trans) const
{
   return HasAxes(trans)
             ? ""
             : "the mesh has no vector \"" + name + "\" for element " +
                  std::to_string(numbers[trans.ElementNo]) +
                  ", or it is zero; each element of a region with this frame "
                  "needs one";
}

} // namespace synovia
