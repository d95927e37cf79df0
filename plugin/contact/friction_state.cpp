#include "synovia/contact/friction_state.hpp"
#include "synovia/general/reduce.hpp"

namespace synovia
{

using namespace mfem;

FrictionState::FrictionState(int size)
   : normal_length(size), pressure(size), vertices(size)
{
   for (VectorByComponent *values :
        {&multiplier, &traction, &slip, &normal, &distance})
   {
      for (Vector &component : *values)
      {
         component.SetSize(size);
         component = 0.0;
      }
   }
   normal_length = 0.0;
   pressure = 0.0;
}

Vector FrictionState::Sliding() const
{
   Vector slides(static_cast<int>(vertices.size()));
   for (int j = 0; j < slides.Size(); j++)
   {
      slides[j] = vertices[j].slides ? 1.0 : 0.0;
   }
   return slides;
}

void FrictionState::Archive(StateArchive &archive, const std::string &prefix,
                            const ContactSurface &destination)
{
   const char *axes[3] = {"_x", "_y", "_z"};
   for (int c = 0; c < 3; c++)
   {
      destination.Archive(archive, prefix + "multiplier" + axes[c],
                          multiplier[c]);
      destination.Archive(archive, prefix + "traction" + axes[c], traction[c]);
   }
   Vector slides = Sliding();
   destination.Archive(archive, prefix + "slides", slides);
   destination.Archive(archive, prefix + "pressure", pressure);
   for (int j = 0; j < slides.Size(); j++)
   {
      vertices[j].slides = slides[j] > 0.5;
   }
   MPI_Comm comm = destination.Spaces().GetComm();
   real_t whole = SumOverRanks(dissipation, comm);
   archive.Number(prefix + "dissipation", whole);
   int rank;
   MPI_Comm_rank(comm, &rank);
   dissipation = rank == 0 ? whole : 0.0;
}

} // namespace synovia
