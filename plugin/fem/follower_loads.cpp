#include "synovia/fem/follower_loads.hpp"
#include "synovia/fem/loaded_face.hpp"

#include <functional>

namespace synovia
{

using namespace mfem;

namespace
{
// Walks through the faces of a boundary.
void ForEachFace(BiphasicSpaces &spaces, const Array<int> &marker,
                 const Vector &u, const std::function<void(LoadedFace &)> &work)
{
   LoadedFace face(spaces);
   const ParMesh &mesh = spaces.GetMesh();
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      if (marker[mesh.GetBdrAttribute(i) - 1])
      {
         face.Set(i, u);
         work(face);
      }
   }
}

void AddForces(LoadedFace &face, real_t traction, Vector &forces)
{
   const int nodes = face.Shape().Size();
   Vector local(3 * nodes);
   local = 0.0;
   for (int q = 0; q < face.Points(); q++)
   {
      face.SetPoint(q);
      for (int a = 0; a < 3; a++)
      {
         const real_t force = face.Weight() * traction * face.Area()[a];
         for (int i = 0; i < nodes; i++)
         {
            local[a * nodes + i] += force * face.Shape()[i];
         }
      }
   }
   forces.AddElementVector(face.DisplacementDofs(), local);
}

void AddInflow(LoadedFace &face, real_t flux, Vector &inflow)
{
   Vector local(face.PressureDofs().Size());
   local = 0.0;
   for (int q = 0; q < face.Points(); q++)
   {
      face.SetPoint(q);
      local.Add(-flux * face.Weight() * Length(face.Area()),
                face.PressureShape());
   }
   inflow.AddElementVector(face.PressureDofs(), local);
}

void SubtractForceChange(LoadedFace &face, real_t traction,
                         LocalMatrix &stiffness)
{
   const int nodes = face.Shape().Size();
   DenseMatrix local(3 * nodes);
   local = 0.0;
   for (int q = 0; q < face.Points(); q++)
   {
      face.SetPoint(q);
      for (int j = 0; j < nodes; j++)
      {
         const Point3 change = face.AreaChange(j);
         for (int b = 0; b < 3; b++)
         {
            // The unit vector along b x change, in its two components.
            const int next = (b + 1) % 3;
            const int last = (b + 2) % 3;
            for (int i = 0; i < nodes; i++)
            {
               const real_t force = face.Weight() * traction * face.Shape()[i];
               local(next * nodes + i, b * nodes + j) += force * change[last];
               local(last * nodes + i, b * nodes + j) -= force * change[next];
            }
         }
      }
   }
   stiffness.Add(face.DisplacementDofs(), face.DisplacementDofs(), local);
}

void SubtractInflowChange(LoadedFace &face, real_t volume,
                          LocalMatrix &flow_change)
{
   const int nodes = face.Shape().Size();
   DenseMatrix local(face.PressureDofs().Size(), 3 * nodes);
   local = 0.0;
   for (int q = 0; q < face.Points(); q++)
   {
      face.SetPoint(q);
      const real_t per_area = face.Weight() * volume / Length(face.Area());
      for (int j = 0; j < nodes; j++)
      {
         const Point3 growth = Cross(face.AreaChange(j), face.Area());
         for (int b = 0; b < 3; b++)
         {
            for (int k = 0; k < local.Height(); k++)
            {
               local(k, b * nodes + j) +=
                  per_area * face.PressureShape()[k] * growth[b];
            }
         }
      }
   }
   flow_change.Add(face.PressureDofs(), face.DisplacementDofs(), local);
}
} // namespace

FollowerLoads::FollowerLoads(BiphasicSpaces &spaces_) : spaces(spaces_) {}

void FollowerLoads::AddTraction(const Array<int> &marker,
                                const LoadCurve &value)
{
   tractions.push_back({marker, value});
}

void FollowerLoads::AddFlux(const Array<int> &marker, const LoadCurve &value)
{
   fluxes.push_back({marker, value});
}

void FollowerLoads::AddLoads(real_t t, const Vector &u, Vector &forces,
                             Vector &inflow) const
{
   for (const Load &load : tractions)
   {
      ForEachFace(spaces, load.marker, u,
                  [&](LoadedFace &face)
                  { AddForces(face, load.value(t), forces); });
   }
   for (const Load &load : fluxes)
   {
      ForEachFace(spaces, load.marker, u,
                  [&](LoadedFace &face)
                  { AddInflow(face, load.value(t), inflow); });
   }
}

void FollowerLoads::SubtractDerivatives(real_t t, real_t dt, const Vector &u,
                                        LocalMatrix &stiffness,
                                        LocalMatrix &flow_change) const
{
   for (const Load &load : tractions)
   {
      ForEachFace(spaces, load.marker, u,
                  [&](LoadedFace &face)
                  { SubtractForceChange(face, load.value(t), stiffness); });
   }
   for (const Load &load : fluxes)
   {
      ForEachFace(
         spaces, load.marker, u,
         [&](LoadedFace &face)
         { SubtractInflowChange(face, dt * load.value(t), flow_change); });
   }
}

} // namespace synovia
