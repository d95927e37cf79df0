#include "synovia/physics/rigid_freedoms.hpp"
#include "synovia/contact/contact_friction.hpp"
#include "synovia/fem/null_space.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/mesh/boundary_marker.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr int per_body = RigidMotions::per_body;
// Part of a motion below which it is round-off.
constexpr real_t tiny = 1e-5;

} // namespace

RigidFreedoms::RigidFreedoms(const std::vector<Body> &bodies,
                             BiphasicSpaces &spaces,
                             const BoundaryConditions &conditions)
   : RigidFreedoms(bodies, RigidMotions(bodies, spaces), spaces, conditions)
{
}

RigidFreedoms::RigidFreedoms(const std::vector<Body> &bodies,
                             RigidMotions motions_, BiphasicSpaces &spaces,
                             const BoundaryConditions &conditions)
   : comm(spaces.GetComm()), motions(std::move(motions_)),
     ties(motions, spaces, conditions)
{
   others = OfSupports(spaces, conditions);
   const DenseMatrix all = WithTies({});
   std::set<int> found;
   for (const Vector &motion : NullSpace(all))
   {
      for (int i = 0; i < motion.Size(); i++)
      {
         if (std::abs(motion[i]) > tiny)
         {
            found.insert(i / per_body);
         }
      }
   }
   loose.assign(found.begin(), found.end());
   for (const int body : loose)
   {
      names.push_back("\"" + bodies[body].name + "\"");
   }
}

DenseMatrix RigidFreedoms::WithTies(const std::vector<bool> &resisting) const
{
   DenseMatrix sum(others);
   ties.AddTo(resisting, sum);
   return sum;
}

DenseMatrix RigidFreedoms::Supports(const std::vector<bool> &resisting) const
{
   const DenseMatrix all = WithTies(resisting);
   const int size = per_body * static_cast<int>(loose.size());
   DenseMatrix supports(size);
   for (int j = 0; j < size; j++)
   {
      for (int i = 0; i < size; i++)
      {
         supports(i, j) = all(per_body * loose[i / per_body] + i % per_body,
                              per_body * loose[j / per_body] + j % per_body);
      }
   }
   return supports;
}

DenseMatrix
RigidFreedoms::OfSupports(BiphasicSpaces &spaces,
                          const BoundaryConditions &conditions) const
{
   const int size = per_body * motions.Bodies();
   DenseMatrix sum(size);
   sum = 0.0;
   DenseMatrix part(size);
   part = 0.0;
   for (const int dof : conditions.DisplacementDofs())
   {
      AddSquare(motions, dof, 1.0, part);
   }
   SumOverRanks(part, comm);
   AddScaled(part, sum);
   for (const DrivenSurface &surface : conditions.DrivenSurfaces())
   {
      AddScaled(OfDriven(spaces, surface), sum);
   }
   for (const SpringFoundation &springs : conditions.Springs())
   {
      AddScaled(OfSprings(springs), sum);
   }
   return sum;
}

DenseMatrix RigidFreedoms::OfDriven(BiphasicSpaces &spaces,
                                    const DrivenSurface &surface) const
{
   // u - d q with the q that fits best.
   const Array<int> marker = BoundaryMarker(spaces.GetMesh(), surface.boundary);
   const int size = per_body * motions.Bodies();
   DenseMatrix part(size);
   part = 0.0;
   Vector mean(size + 1);
   mean = 0.0;
   for (int d = 0; d < 3; d++)
   {
      const real_t share = surface.direction[d];
      Array<int> dofs;
      spaces.Displacement().GetEssentialTrueDofs(marker, dofs, d);
      for (int i = 0; share != 0.0 && i < dofs.Size(); i++)
      {
         AddSquare(motions, dofs[i], 1.0, part);
         const int first = per_body * motions.BodyOf(dofs[i]);
         for (int m = 0; m < per_body; m++)
         {
            mean[first + m] += share * motions.At(dofs[i], m);
         }
         mean[size] += share * share;
      }
   }
   SumOverRanks(part, comm);
   MPI_Allreduce(MPI_IN_PLACE, mean.GetData(), mean.Size(),
                 MPITypeMap<real_t>::mpi_type, MPI_SUM, comm);
   for (int j = 0; j < size; j++)
   {
      for (int i = 0; i < size; i++)
      {
         part(i, j) -= mean[i] * mean[j] / mean[size];
      }
   }
   return part;
}

DenseMatrix RigidFreedoms::OfSprings(const SpringFoundation &springs) const
{
   const int bodies = motions.Bodies();
   DenseMatrix part(per_body * bodies);
   part = 0.0;
   for (int m = 0; m < per_body; m++)
   {
      // Springs don't couple bodies.
      const Vector motion = motions.OfAll(m);
      Vector force(motion.Size());
      springs.Matrix().Mult(1.0, motion, 0.0, force);
      force.HostRead();
      for (int dof = 0; dof < force.Size(); dof++)
      {
         const int first = per_body * motions.BodyOf(dof);
         for (int i = 0; force[dof] != 0.0 && i < per_body; i++)
         {
            part(first + i, first + m) += motions.At(dof, i) * force[dof];
         }
      }
   }
   SumOverRanks(part, comm);
   return part;
}

DenseMatrix RigidFreedoms::OfContact(const ContactPair &pair,
                                     real_t least_force) const
{
   // Vertices that bear next to nothing may as well bear nothing.
   constexpr real_t counts = 1e-6;
   const int size = per_body * static_cast<int>(loose.size());
   DenseMatrix part(size);
   part = 0.0;
   const Vector &area = pair.Constraint().Coverage().area;
   Vector force(area.Size());
   for (int j = 0; j < force.Size(); j++)
   {
      force[j] = std::max(0.0, -pair.State().traction[j] * area[j]);
   }
   const real_t whole = synovia::SumOverRanks(force.Sum(), comm);
   if (!(whole > least_force))
   {
      return part;
   }
   const auto add = [&](const HypreParMatrix &map, const auto &holds)
   {
      std::vector<Vector> rows;
      for (const int body : loose)
      {
         for (int m = 0; m < per_body; m++)
         {
            rows.emplace_back(area.Size());
            map.Mult(1.0, motions.Displacement(body, m), 0.0, rows.back());
            rows.back().HostRead();
         }
      }
      for (int j = 0; j < force.Size(); j++)
      {
         for (int a = 0; force[j] > counts * whole && holds(j) && a < size; a++)
         {
            for (int b = 0; b < size; b++)
            {
               part(a, b) += area[j] * rows[a][j] * rows[b][j];
            }
         }
      }
   };
   add(*pair.Factors().gap, [](int) { return true; });
   if (const ContactFriction *friction = pair.Enforcement().Friction())
   {
      for (const auto &component : friction->Distance())
      {
         add(*component,
             [&](int j) { return !pair.State().friction.vertices[j].slides; });
      }
   }
   SumOverRanks(part, comm);
   return part;
}

std::vector<Vector> RigidFreedoms::WithoutContact() const
{
   std::vector<Vector> all;
   for (const Vector &motion : NullSpace(Supports(ties.AllLigaments())))
   {
      all.emplace_back(per_body * motions.Bodies());
      all.back() = 0.0;
      for (int i = 0; i < motion.Size(); i++)
      {
         all.back()[per_body * loose[i / per_body] + i % per_body] = motion[i];
      }
   }
   return all;
}

std::string RigidFreedoms::Validate(const std::vector<ContactPair *> &pairs,
                                    real_t least_force,
                                    const std::vector<bool> &resisting) const
{
   if (HoldAll())
   {
      return "";
   }
   DenseMatrix all = Supports(resisting);
   for (const ContactPair *pair : pairs)
   {
      AddScaled(OfContact(*pair, least_force), all);
   }
   // By the bodies that move together.
   std::map<std::string, std::string> freedoms;
   for (const Vector &motion : NullSpace(all))
   {
      std::string together;
      std::string how;
      for (int i = 0; i < static_cast<int>(loose.size()); i++)
      {
         const Vector part(motion.GetData() + per_body * i, per_body);
         if (part.Normlinf() > tiny)
         {
            together += (together.empty() ? "" : " and ") + names[i];
            const RigidDirection direction =
               motions.Direction(loose[i], part.GetData());
            how = !how.empty()
                     ? how
                     : (direction.turns ? "turn " : "move ") + direction.text;
         }
      }
      std::string &text = freedoms[together];
      text += (text.empty() ? "" : ", ") + how;
   }
   std::string failure;
   for (const auto &[together, how] : freedoms)
   {
      failure += (failure.empty() ? "nothing holds " : "; nothing holds ") +
                 together + ", free to " + how;
   }
   return failure.empty()
             ? failure
             : failure +
                  "; prescribe a displacement there, hold it by springs, or "
                  "let contact press on it (contact without traction holds "
                  "nothing" +
                  (resisting.empty() ? ")" : ", nor does a slack ligament)");
}

} // namespace synovia
