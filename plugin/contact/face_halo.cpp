#include "synovia/contact/face_halo.hpp"
#include "synovia/general/exchange.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

FaceHalo::FaceHalo(const ContactSurface &surface_) : surface(surface_) {}

void FaceHalo::Ask(const SurfaceSearch &search,
                   const std::vector<FaceName> &names)
{
   MPI_Comm comm = surface.Spaces().GetComm();
   int ranks;
   MPI_Comm_size(comm, &ranks);
   std::vector<FaceDofs> dofs = search.GetFaceDofs(names);
   faces.resize(names.size());
   mine.assign(ranks, {});
   std::vector<std::vector<int>> requests(ranks);
   for (std::size_t i = 0; i < names.size(); i++)
   {
      faces[i].dofs = std::move(dofs[i]);
      mine[names[i].first].push_back(static_cast<int>(i));
      requests[names[i].first].push_back(names[i].second);
   }
   asked = Exchange(std::move(requests), comm);
   Fetch(&DeformedFace::ReferenceShape, &HaloFace::reference);
}

template <typename Append, typename Take>
void FaceHalo::Send(const Append &append, const Take &take)
{
   std::vector<std::vector<real_t>> outgoing(asked.size());
   for (std::size_t r = 0; r < asked.size(); r++)
   {
      for (const int face : asked[r])
      {
         append(surface.Faces()[face], outgoing[r]);
      }
   }
   const auto incoming =
      Exchange(std::move(outgoing), surface.Spaces().GetComm());
   for (std::size_t r = 0; r < mine.size(); r++)
   {
      const real_t *values = incoming[r].data();
      for (const int i : mine[r])
      {
         values = take(i, values);
      }
   }
}

void FaceHalo::Fetch(ShapeOf shape_of, FacePolynomial HaloFace::*shape)
{
   Send(
      [shape_of](const DeformedFace &face, std::vector<real_t> &values)
      {
         const FacePolynomial &mine = (face.*shape_of)();
         const DenseMatrix &c = mine.Coefficients();
         values.push_back(mine.Order());
         values.insert(values.end(), c.Data(),
                       c.Data() + c.Height() * c.Width());
      },
      [this, shape](int i, const real_t *values)
      {
         FacePolynomial &own = faces[i].*shape;
         own =
            FacePolynomial(faces[i].dofs.geometry, static_cast<int>(*values++));
         DenseMatrix &c = own.Coefficients();
         const int size = c.Height() * c.Width();
         std::copy(values, values + size, c.Data());
         return values + size;
      });
}

void FaceHalo::UpdateShapes()
{
   Fetch(&DeformedFace::CurrentShape, &HaloFace::shape);
}

void FaceHalo::UpdatePressures(const Vector &p)
{
   ParGridFunction local(&surface.Spaces().Pressure());
   local.SetFromTrueDofs(p);
   local.HostRead();
   Send(
      [&local](const DeformedFace &face, std::vector<real_t> &values)
      {
         for (const int dof : face.PressureDofs())
         {
            values.push_back(local[dof]);
         }
      },
      [this](int i, const real_t *values)
      {
         Vector &pressure = faces[i].pressure;
         pressure.SetSize(static_cast<int>(faces[i].dofs.pressure.size()));
         std::copy(values, values + pressure.Size(), pressure.GetData());
         return values + pressure.Size();
      });
}

} // namespace synovia
