#include "synovia/fem/strain_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
// More than what linear systems leave on one number of ranks or another.
constexpr real_t same_part = 1e-6;
constexpr real_t nothing = -std::numeric_limits<real_t>::infinity();

// What is as much as the largest.
real_t LeastLike(real_t largest)
{
   return largest - same_part * std::abs(largest);
}

// Columns of grad u at the points of an element.
struct Components
{
   explicit Components(const DisplacementGradient &from)
      : xx(from.Component(0, 0)), xy(from.Component(0, 1)),
        xz(from.Component(0, 2)), yx(from.Component(1, 0)),
        yy(from.Component(1, 1)), yz(from.Component(1, 2)),
        zx(from.Component(2, 0)), zy(from.Component(2, 1)),
        zz(from.Component(2, 2))
   {
   }
   const real_t *xx, *xy, *xz, *yx, *yy, *yz, *zx, *zy, *zz;
};

// Of the strain.
real_t FrobeniusNorm(const Components &g, int q)
{
   const real_t xy = g.xy[q] + g.yx[q];
   const real_t yz = g.yz[q] + g.zy[q];
   const real_t xz = g.xz[q] + g.zx[q];
   return std::sqrt(g.xx[q] * g.xx[q] + g.yy[q] * g.yy[q] + g.zz[q] * g.zz[q] +
                    0.5 * (xy * xy + yz * yz + xz * xz));
}

real_t DetF(const Components &g, int q)
{
   const real_t xx = 1.0 + g.xx[q];
   const real_t yy = 1.0 + g.yy[q];
   const real_t zz = 1.0 + g.zz[q];
   return xx * (yy * zz - g.yz[q] * g.zy[q]) -
          g.xy[q] * (g.yx[q] * zz - g.yz[q] * g.zx[q]) +
          g.xz[q] * (g.yx[q] * g.zy[q] - yy * g.zx[q]);
}

// The largest magnitude of an eigenvalue of the strain, to half of the digits:
// roots of the characteristic polynomial by cosines.
real_t SpectralNorm(const Components &g, int q)
{
   const real_t mean = (g.xx[q] + g.yy[q] + g.zz[q]) / 3.0;
   const real_t xx = g.xx[q] - mean;
   const real_t yy = g.yy[q] - mean;
   const real_t zz = g.zz[q] - mean;
   const real_t xy = 0.5 * (g.xy[q] + g.yx[q]);
   const real_t yz = 0.5 * (g.yz[q] + g.zy[q]);
   const real_t xz = 0.5 * (g.xz[q] + g.zx[q]);
   const real_t size = std::sqrt(
      (xx * xx + yy * yy + zz * zz + 2.0 * (xy * xy + yz * yz + xz * xz)) /
      6.0);
   const real_t det = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) +
                      xz * (xy * yz - yy * xz);
   const real_t cube = size * size * size;
   const real_t cosine =
      cube > 0.0 ? std::clamp(0.5 * det / cube, -1.0, 1.0) : 1.0;
   const real_t angle = std::acos(cosine) / 3.0;
   constexpr real_t third_of_turn = 2.0 * M_PI / 3.0;
   return std::max(mean + 2.0 * size * std::cos(angle),
                   -mean - 2.0 * size * std::cos(angle + third_of_turn));
}

// The largest in magnitude, to all digits.
real_t PrincipalStrain(DenseMatrix gradient)
{
   gradient.Symmetrize();
   real_t principal[3]; // ascending
   real_t directions[9];
   gradient.CalcEigenvalues(principal, directions);
   return principal[2] >= LeastLike(-principal[0]) ? principal[2]
                                                   : principal[0];
}
} // namespace

StrainMonitor::StrainMonitor(NamedMesh &mesh_,
                             const ParGridFunction &displacement)
   : mesh(mesh_), gradients(mesh_.Get(), displacement),
     severities(mesh_.Get().GetNE())
{
}

void StrainMonitor::MeasureElements()
{
   constexpr real_t more = 1.0 + 1e-9; // not by rounding alone
   real_t largest = nothing;
   for (size_t e = 0; e < severities.size(); e++)
   {
      gradients.SetElement(static_cast<int>(e));
      const Components components(gradients);
      Severity &severity = severities[e];
      severity.fill(nothing);
      for (int q = 0; q < gradients.Points(); q++)
      {
         severity[volume_loss] =
            std::max(severity[volume_loss], 1.0 - DetF(components, q));
         // No eigenvalue exceeds it.
         const real_t norm = FrobeniusNorm(components, q);
         if (norm >= LeastLike(largest) && norm > more * severity[strain])
         {
            severity[strain] =
               std::max(severity[strain], SpectralNorm(components, q));
            largest = std::max(largest, severity[strain]);
         }
      }
   }
}

StrainExtremes StrainMonitor::Measure()
{
   MeasureElements();
   Severity worst{{nothing, nothing}};
   for (const Severity &severity : severities)
   {
      worst[strain] = std::max(worst[strain], severity[strain]);
      worst[volume_loss] = std::max(worst[volume_loss], severity[volume_loss]);
   }
   MPI_Allreduce(MPI_IN_PLACE, worst.data(), 2, MPITypeMap<real_t>::mpi_type,
                 MPI_MAX, mesh.GetComm());
   return {Locate(strain, LeastLike(worst[strain])),
           Locate(volume_loss, LeastLike(worst[volume_loss]))};
}

StrainExtreme StrainMonitor::Locate(Kind kind, real_t least)
{
   const std::vector<int> &numbers = mesh.SerialElements();
   int mine = -1;
   int first = std::numeric_limits<int>::max();
   for (size_t e = 0; e < severities.size(); e++)
   {
      if (severities[e][kind] >= least && numbers[e] < first)
      {
         first = numbers[e];
         mine = static_cast<int>(e);
      }
   }
   const int own = first;
   MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, mesh.GetComm());

   // Value, place and attribute; zero where the element is not.
   std::array<real_t, 5> found{};
   if (mine >= 0 && own == first)
   {
      gradients.SetElement(mine);
      const Components components(gradients);
      const DenseMatrix places = gradients.Places();
      for (int q = 0; q < gradients.Points() && found[4] == 0.0; q++)
      {
         const real_t value = kind == strain ? PrincipalStrain(gradients.At(q))
                                             : DetF(components, q);
         if ((kind == strain ? std::abs(value) : 1.0 - value) >= least)
         {
            found = {value, places(0, q), places(1, q), places(2, q),
                     static_cast<real_t>(gradients.Attribute())};
         }
      }
   }
   MPI_Allreduce(MPI_IN_PLACE, found.data(), 5, MPITypeMap<real_t>::mpi_type,
                 MPI_SUM, mesh.GetComm());
   const int attribute = static_cast<int>(std::lround(found[4]));
   return {found[0],
           NameOf(mesh.Regions(), attribute),
           {{found[1], found[2], found[3]}}};
}

} // namespace synovia
