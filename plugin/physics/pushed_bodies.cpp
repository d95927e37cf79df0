#include "synovia/physics/pushed_bodies.hpp"
#include "synovia/contact/clearance.hpp"
#include "synovia/general/reduce.hpp"

namespace synovia
{

using namespace mfem;

bool PushedBodies::AreHeldBy(const std::vector<ContactPair *> &pairs) const
{
   // Beside 1, that of a surface that faces the force.
   constexpr real_t slides = 1e-3;
   bool held = false;
   MPI_Comm comm = MPI_COMM_SELF;
   for (const ContactPair *pair : pairs)
   {
      comm = pair->Geometry().Source().Spaces().GetComm();
      const std::vector<VertexContact> &vertices = pair->State().vertices;
      Vector closing(static_cast<int>(vertices.size()));
      pair->Factors().gap_change->Mult(-1.0, translation, 0.0, closing);
      closing.HostRead();
      for (int j = 0; j < closing.Size(); j++)
      {
         held = held || (vertices[j].touches && closing[j] > slides);
      }
   }
   return AnyRank(held, comm);
}

real_t PushedBodies::Clearance(const std::vector<ContactPair *> &pairs) const
{
   synovia::Clearance least;
   for (const ContactPair *pair : pairs)
   {
      least.TakeLess(FindClearance(*pair, translation));
   }
   return least.ahead;
}

} // namespace synovia
