#include "synovia/linalg/shared_directions.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

SharedDirections::SharedDirections(MPI_Comm comm_, const Operator &a_,
                                   const Operator &preconditioner_)
   : comm(comm_), a(a_), preconditioner(preconditioner_)
{
}

std::vector<Vector> SharedDirections::Precondition(const std::vector<Vector> &r)
{
   std::vector<Vector> z(r.size(), Vector(a.Width()));
   Array<const Vector *> from;
   Array<Vector *> to;
   for (std::size_t j = 0; j < r.size(); j++)
   {
      from.Append(&r[j]);
      to.Append(&z[j]);
   }
   preconditioner.ArrayMult(from, to);
   return z;
}

Vector SharedDirections::Products(const Vector &y) const
{
   Vector dots(static_cast<int>(directions.size()));
   for (int k = 0; k < dots.Size(); k++)
   {
      dots[k] = directions[k].product * y;
   }
   MPI_Allreduce(MPI_IN_PLACE, dots.GetData(), dots.Size(),
                 MPITypeMap<real_t>::mpi_type, MPI_SUM, comm);
   return dots;
}

bool SharedDirections::Append(Vector &&z)
{
   // Less than that of a product is round-off of the others'.
   constexpr real_t nothing = 1e-10;
   Direction added;
   added.z = std::move(z);
   added.product.SetSize(a.Height());
   a.Mult(added.z, added.product);
   const real_t before =
      std::sqrt(InnerProduct(comm, added.product, added.product));
   // Twice is enough (Giraud et al. 2005).
   for (int pass = 0; pass < 2; pass++)
   {
      const Vector dots = Products(added.product);
      for (int k = 0; k < dots.Size(); k++)
      {
         added.product.Add(-dots[k], directions[k].product);
         added.z.Add(-dots[k], directions[k].z);
      }
   }
   const real_t length =
      std::sqrt(InnerProduct(comm, added.product, added.product));
   if (!(length > nothing * before))
   {
      return false;
   }
   added.product /= length;
   added.z /= length;
   directions.push_back(std::move(added));
   return true;
}

void SharedDirections::Solve(int most, const std::vector<Vector> &b,
                             const Vector &targets, std::vector<Vector> &x)
{
   directions.clear();
   std::vector<Vector> residuals(b);
   const auto all_solved = [&]()
   {
      bool solved = true;
      for (std::size_t j = 0; j < b.size(); j++)
      {
         const Vector &r = residuals[j];
         solved = std::sqrt(InnerProduct(comm, r, r)) <= targets[j] && solved;
      }
      return solved;
   };
   for (std::size_t j = 0; j < b.size(); j++)
   {
      a.AddMult(x[j], residuals[j], -1.0);
   }
   for (int i = 0; i < most && !all_solved(); i++)
   {
      for (Vector &z : Precondition(residuals))
      {
         if (!Append(std::move(z)))
         {
            continue;
         }
         const Direction &last = directions.back();
         for (std::size_t j = 0; j < b.size(); j++)
         {
            const real_t amount =
               InnerProduct(comm, last.product, residuals[j]);
            x[j].Add(amount, last.z);
            residuals[j].Add(-amount, last.product);
         }
      }
   }
}

} // namespace synovia
