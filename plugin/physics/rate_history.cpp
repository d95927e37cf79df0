#include "synovia/physics/rate_history.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
// Of the parts of @a a and @a b before @a split and from there on.
std::array<real_t, 2> SquaredDistances(const Vector &a, const Vector &b,
                                       int split, MPI_Comm comm)
{
   std::array<real_t, 2> squares{{0.0, 0.0}};
   for (int i = 0; i < a.Size(); i++)
   {
      const real_t difference = a[i] - b[i];
      squares[i < split ? 0 : 1] += difference * difference;
   }
   MPI_Allreduce(MPI_IN_PLACE, squares.data(), 2, MPITypeMap<real_t>::mpi_type,
                 MPI_SUM, comm);
   return squares;
}
} // namespace

RateHistory::RateHistory(BiphasicSpaces &spaces_)
   : spaces(&spaces_), last(spaces->Offsets().Last()), before(last.Size())
{
   Forget();
}

void RateHistory::Forget()
{
   last = 0.0;
   before = 0.0;
   stages = 0;
   is_smooth = false;
}

bool RateHistory::Reaches(real_t time) const
{
   // Where steps grow, differences of small ones tell little of large ones.
   constexpr real_t farthest = 3.0;
   const real_t between = last_time - before_time;
   return stages == 2 && between > 0.0 &&
          time - last_time <= farthest * between;
}

Vector RateHistory::OnLine(real_t time) const
{
   const real_t share = (time - last_time) / (last_time - before_time);
   Vector rate(before.Size());
   for (int i = 0; i < rate.Size(); i++)
   {
      rate[i] = last[i] + share * (last[i] - before[i]);
   }
   return rate;
}

Vector RateHistory::Expected(real_t time) const
{
   if (is_smooth && Reaches(time))
   {
      return OnLine(time);
   }
   return last;
}

void RateHistory::Add(real_t time, real_t dt, const Vector &rate)
{
   // Differences of rates are taken on the host.
   rate.HostRead();
   const Vector now(const_cast<Vector &>(rate), 0, before.Size());
   is_smooth = false;
   if (Reaches(time))
   {
      // Half of the last rate's error, squared.
      constexpr real_t closer = 0.25;
      const int split = spaces->Offsets()[1];
      const auto from_line =
         SquaredDistances(now, OnLine(time), split, spaces->GetComm());
      const auto from_last =
         SquaredDistances(now, last, split, spaces->GetComm());
      is_smooth = from_line[0] <= closer * from_last[0] &&
                  from_line[1] <= closer * from_last[1];
   }
   before = last;
   before_time = last_time;
   last = now;
   last_time = time;
   last_length = dt;
   stages = std::min(stages + 1, 2);
}

void RateHistory::Archive(StateArchive &archive)
{
   const auto list = [&](const std::string &name, Vector &rate)
   {
      const Array<int> &offsets = spaces->Offsets();
      Vector velocity(rate, offsets[0], offsets[1] - offsets[0]);
      Vector pressure_rate(rate, offsets[1], offsets[2] - offsets[1]);
      archive.Field(name + ".displacement", spaces->Displacement(), velocity);
      archive.Field(name + ".pressure", spaces->Pressure(), pressure_rate);
   };
   list("rate", last);
   list("rate.before", before);
   archive.Number("rate.time", last_time);
   archive.Number("rate.length", last_length);
   archive.Number("rate.before.time", before_time);
   archive.Count("rate.stages", stages);
   archive.Flag("rate.is_smooth", is_smooth);
}

} // namespace synovia
