#include "synovia/fem/strain_monitor.hpp"
#include "synovia/fem/principal_strain.hpp"

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

// Values from here on count as the largest.
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

struct Symmetric
{
   real_t xx, yy, zz, xy, yz, xz;
};

Symmetric InfinitesimalStrain(const Components &g, int q)
{
   return {g.xx[q],
           g.yy[q],
           g.zz[q],
           0.5 * (g.xy[q] + g.yx[q]),
           0.5 * (g.yz[q] + g.zy[q]),
           0.5 * (g.xz[q] + g.zx[q])};
}

// Green's, as in principal_strain.hpp.
Symmetric FiniteStrain(const Components &g, int q)
{
   const real_t x[3] = {g.xx[q], g.yx[q], g.zx[q]};
   const real_t y[3] = {g.xy[q], g.yy[q], g.zy[q]};
   const real_t z[3] = {g.xz[q], g.yz[q], g.zz[q]};
   const auto half = [](const real_t *a, const real_t *b)
   { return 0.5 * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]); };
   Symmetric strain = InfinitesimalStrain(g, q);
   strain.xx += half(x, x);
   strain.yy += half(y, y);
   strain.zz += half(z, z);
   strain.xy += half(x, y);
   strain.yz += half(y, z);
   strain.xz += half(x, z);
   return strain;
}

struct Range
{
   real_t smallest;
   real_t largest;
};

// Of the eigenvalues, to half of the digits: roots of the characteristic
// polynomial by cosines.
Range Eigenvalues(const Symmetric &strain)
{
   const real_t mean = (strain.xx + strain.yy + strain.zz) / 3.0;
   const real_t xx = strain.xx - mean;
   const real_t yy = strain.yy - mean;
   const real_t zz = strain.zz - mean;
   const real_t xy = strain.xy;
   const real_t yz = strain.yz;
   const real_t xz = strain.xz;
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
   return {mean + 2.0 * size * std::cos(angle + third_of_turn),
           mean + 2.0 * size * std::cos(angle)};
}

// The largest magnitude of a principal strain.
real_t SpectralNorm(const Components &g, int q, Deformation deformation)
{
   if (deformation == Deformation::infinitesimal)
   {
      const Range strains = Eigenvalues(InfinitesimalStrain(g, q));
      return std::max(strains.largest, -strains.smallest);
   }
   const Range strains = Eigenvalues(FiniteStrain(g, q));
   return std::max(LogarithmicStrain(strains.largest),
                   -LogarithmicStrain(strains.smallest));
}

// An upper bound of the principal strains.
real_t Bound(const Components &g, int q, Deformation deformation)
{
   return deformation == Deformation::infinitesimal
             ? FrobeniusNorm(g, q)
             : std::numeric_limits<real_t>::infinity();
}
} // namespace

StrainMonitor::StrainMonitor(NamedMesh &mesh_,
                             const ParGridFunction &displacement,
                             Deformation deformation_, const Array<int> &rigid_)
   : mesh(mesh_), deformation(deformation_), rigid(rigid_),
     gradients(mesh_.Get(), displacement), severities(mesh_.Get().GetNE())
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
      if (rigid.Find(mesh.Get().GetAttribute(static_cast<int>(e))) >= 0)
      {
         continue;
      }
      for (int q = 0; q < gradients.Points(); q++)
      {
         severity[volume_loss] =
            std::max(severity[volume_loss], 1.0 - DetF(components, q));
         const real_t bound = Bound(components, q, deformation);
         if (bound >= LeastLike(largest) && bound > more * severity[strain])
         {
            severity[strain] = std::max(
               severity[strain], SpectralNorm(components, q, deformation));
            largest = std::max(largest, severity[strain]);
         }
      }
   }
}

real_t StrainMonitor::PrincipalStrain(const DenseMatrix &gradient) const
{
   real_t principal[3]; // ascending
   real_t directions[9];
   if (deformation == Deformation::infinitesimal)
   {
      DenseMatrix strain(gradient);
      strain.Symmetrize();
      strain.CalcEigenvalues(principal, directions);
   }
   else
   {
      GreenStrain(gradient).CalcEigenvalues(principal, directions);
      for (real_t &value : principal)
      {
         value = LogarithmicStrain(value);
      }
   }
   return principal[2] >= LeastLike(-principal[0]) ? principal[2]
                                                   : principal[0];
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
