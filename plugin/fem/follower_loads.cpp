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

using Traction = std::function<real_t(const LoadedFace &)>;

// The same everywhere.
Traction Uniform(real_t traction)
{
   return [traction](const LoadedFace &) { return traction; };
}

// At the point of a face: the solid's traction, less the fluid's pressure.
Traction Effective(real_t traction, const Vector &p)
{
   return [traction, &p](const LoadedFace &face)
   {
      Vector at_dofs;
      p.GetSubVector(face.PressureDofs(), at_dofs);
      return traction - at_dofs * face.PressureShape();
   };
}

void AddForces(LoadedFace &face, const Traction &traction, Vector &forces)
{
   const int nodes = face.Shape().Size();
   Vector local(3 * nodes);
   local = 0.0;
   for (int q = 0; q < face.Points(); q++)
   {
      face.SetPoint(q);
      const real_t total = face.Weight() * traction(face);
      for (int a = 0; a < 3; a++)
      {
         const real_t force = total * face.Area()[a];
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

void SubtractForceChange(LoadedFace &face, const Traction &traction,
                         AssembledMatrix &stiffness)
{
   const int nodes = face.Shape().Size();
   DenseMatrix local(3 * nodes);
   local = 0.0;
   for (int q = 0; q < face.Points(); q++)
   {
      face.SetPoint(q);
      const real_t total = face.Weight() * traction(face);
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
               const real_t force = total * face.Shape()[i];
               local(next * nodes + i, b * nodes + j) += force * change[last];
               local(last * nodes + i, b * nodes + j) -= force * change[next];
            }
         }
      }
   }
   stiffness.Add(face.DisplacementDofs(), face.DisplacementDofs(), local);
}

// The force of the fluid's pressure is -int p n.w da.
void AddPressureChange(LoadedFace &face, AssembledMatrix &coupling)
{
   const int nodes = face.Shape().Size();
   DenseMatrix local(face.PressureDofs().Size(), 3 * nodes);
   local = 0.0;
   for (int q = 0; q < face.Points(); q++)
   {
      face.SetPoint(q);
      for (int a = 0; a < 3; a++)
      {
         const real_t area = face.Weight() * face.Area()[a];
         for (int i = 0; i < nodes; i++)
         {
            for (int k = 0; k < local.Height(); k++)
            {
               local(k, a * nodes + i) -=
                  area * face.Shape()[i] * face.PressureShape()[k];
            }
         }
      }
   }
   coupling.AddTransposed(face.DisplacementDofs(), face.PressureDofs(), local);
}

// The increment of the displacement at the point of a face.
Point3 Increment(const LoadedFace &face, const FollowerLoads::State &state)
{
   Vector now;
   Vector before;
   state.u.GetSubVector(face.DisplacementDofs(), now);
   state.u0.GetSubVector(face.DisplacementDofs(), before);
   now -= before;
   const int nodes = face.Shape().Size();
   Point3 increment{{0.0, 0.0, 0.0}};
   for (int a = 0; a < 3; a++)
   {
      for (int i = 0; i < nodes; i++)
      {
         increment[a] += face.Shape()[i] * now[a * nodes + i];
      }
   }
   return increment;
}

// The volume that the surface sweeps: of a given flux of the mixture what the
// solid's motion doesn't carry is relative.
void AddSweptInflow(LoadedFace &face, const FollowerLoads::State &state,
                    Vector &inflow)
{
   Vector local(face.PressureDofs().Size());
   local = 0.0;
   for (int q = 0; q < face.Points(); q++)
   {
      face.SetPoint(q);
      local.Add(face.Weight() * Dot(Increment(face, state), face.Area()) /
                   state.dt,
                face.PressureShape());
   }
   inflow.AddElementVector(face.PressureDofs(), local);
}

void SubtractSweptChange(LoadedFace &face, const FollowerLoads::State &state,
                         AssembledMatrix &flow_change)
{
   const int nodes = face.Shape().Size();
   DenseMatrix local(face.PressureDofs().Size(), 3 * nodes);
   local = 0.0;
   for (int q = 0; q < face.Points(); q++)
   {
      face.SetPoint(q);
      const Point3 increment = Increment(face, state);
      for (int j = 0; j < nodes; j++)
      {
         // increment . (d x change) = d . (change x increment)
         const Point3 turned = Cross(face.AreaChange(j), increment);
         for (int b = 0; b < 3; b++)
         {
            const real_t change =
               face.Weight() * (face.Shape()[j] * face.Area()[b] + turned[b]);
            for (int k = 0; k < local.Height(); k++)
            {
               local(k, b * nodes + j) -= change * face.PressureShape()[k];
            }
         }
      }
   }
   flow_change.Add(face.PressureDofs(), face.DisplacementDofs(), local);
}

void SubtractInflowChange(LoadedFace &face, real_t volume,
                          AssembledMatrix &flow_change)
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

void FollowerLoads::AddEffectiveTraction(const Array<int> &marker,
                                         const LoadCurve &value)
{
   effective_tractions.push_back({marker, value});
}

void FollowerLoads::AddFlux(const Array<int> &marker, const LoadCurve &value)
{
   fluxes.push_back({marker, value});
}

void FollowerLoads::AddMixtureFlux(const Array<int> &marker,
                                   const LoadCurve &value)
{
   mixture_fluxes.push_back({marker, value});
}

template <typename Work>
void FollowerLoads::ForEachLoad(const std::vector<Load> &loads,
                                const State &state, const Work &work) const
{
   for (const Load &load : loads)
   {
      const real_t value = load.value(state.t);
      ForEachFace(spaces, load.marker, state.u,
                  [&](LoadedFace &face) { work(face, value); });
   }
}

void FollowerLoads::AddLoads(const State &state, Vector &forces,
                             Vector &inflow) const
{
   ForEachLoad(tractions, state,
               [&](LoadedFace &face, real_t value)
               { AddForces(face, Uniform(value), forces); });
   ForEachLoad(effective_tractions, state,
               [&](LoadedFace &face, real_t value)
               { AddForces(face, Effective(value, state.p), forces); });
   ForEachLoad(fluxes, state,
               [&](LoadedFace &face, real_t value)
               { AddInflow(face, value, inflow); });
   ForEachLoad(mixture_fluxes, state,
               [&](LoadedFace &face, real_t value)
               {
                  AddInflow(face, value, inflow);
                  AddSweptInflow(face, state, inflow);
               });
}

void FollowerLoads::AddDerivatives(const State &state,
                                   AssembledMatrix &stiffness,
                                   AssembledMatrix &coupling,
                                   AssembledMatrix &flow_change) const
{
   ForEachLoad(tractions, state,
               [&](LoadedFace &face, real_t value)
               { SubtractForceChange(face, Uniform(value), stiffness); });
   ForEachLoad(effective_tractions, state,
               [&](LoadedFace &face, real_t value)
               {
                  SubtractForceChange(face, Effective(value, state.p),
                                      stiffness);
                  AddPressureChange(face, coupling);
               });
   ForEachLoad(fluxes, state,
               [&](LoadedFace &face, real_t value)
               { SubtractInflowChange(face, state.dt * value, flow_change); });
   ForEachLoad(mixture_fluxes, state,
               [&](LoadedFace &face, real_t value)
               {
                  SubtractInflowChange(face, state.dt * value, flow_change);
                  SubtractSweptChange(face, state, flow_change);
               });
}

} // namespace synovia
