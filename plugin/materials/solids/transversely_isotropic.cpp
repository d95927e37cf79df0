#include "synovia/materials/solids/transversely_isotropic.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/symmetric_eigenvalues.hpp"
#include "synovia/general/text.hpp"
#include "synovia/materials/tensor3.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// Pairs of axes in Voigt's order.

// Strains in the axes from strains in space, both with engineering shear.
void GetStrainMap(const Tensor3<> &axes, DenseMatrix &map)
{
   map.SetSize(6);
   for (int m = 0; m < 6; m++)
   {
      const int a = symmetric_entries[m][0];
      const int b = symmetric_entries[m][1];
      const real_t shear = a == b ? 1.0 : 2.0;
      for (int n = 0; n < 6; n++)
      {
         const int i = symmetric_entries[n][0];
         const int j = symmetric_entries[n][1];
         map(m, n) =
            0.5 * shear * (axes[i][a] * axes[j][b] + axes[j][a] * axes[i][b]);
      }
   }
}
} // namespace

LawDescription TransverselyIsotropic::Describe()
{
   const NumberRange positive = NumberRange::Positive();
   return {
      "transversely_isotropic",
      "linear elastic, with fibers along theta of the frame",
      Deformation::infinitesimal,
      {{"E_r", "stress", "Young's modulus across the fibers", positive, {}},
       {"E_theta", "stress", "Young's modulus along the fibers", positive, {}},
       {"nu_rtheta",
        "",
        "the contraction along the fibers under tension across them",
        {},
        {}},
       {"nu_rz", "", "Poisson's ratio across the fibers", {}, {}},
       {"G_rtheta",
        "stress",
        "the shear modulus along the fibers",
        positive,
        {}}}};
}

TransverselyIsotropic::TransverselyIsotropic(const LawArguments &from)
   : TransverselyIsotropic(FiberConstants{from["E_r"], from["E_theta"],
                                          from["nu_rtheta"], from["nu_rz"],
                                          from["G_rtheta"]},
                           from.frame)
{
}

TransverselyIsotropic::TransverselyIsotropic(const FiberConstants &constants,
                                             const MaterialFrame &frame_)
   : frame(frame_), local(6)
{
   Describe().Verify({constants.young_r, constants.young_theta,
                      constants.poisson_rtheta, constants.poisson_rz,
                      constants.shear_rtheta});
   DenseMatrix compliance(3);
   compliance = -constants.poisson_rtheta / constants.young_r;
   compliance(0, 2) = compliance(2, 0) =
      -constants.poisson_rz / constants.young_r;
   compliance(0, 0) = compliance(2, 2) = 1.0 / constants.young_r;
   compliance(1, 1) = 1.0 / constants.young_theta;
   const Vector eigenvalues = SymmetricEigenvalues(compliance);
   if (!(eigenvalues.Min() > 0.0) || !(constants.poisson_rz > -1.0))
   {
      throw Error("the stiffness is not positive definite: the compliance of "
                  "normal stresses has the eigenvalues " +
                  ToText(eigenvalues[0]) + ", " + ToText(eigenvalues[1]) +
                  ", " + ToText(eigenvalues[2]) +
                  "; nu_rtheta = " + ToText(constants.poisson_rtheta) +
                  " and nu_rz = " + ToText(constants.poisson_rz) +
                  " must satisfy -1 < nu_rz < 1 - 2 nu_rtheta^2 E_theta/E_r");
   }
   compliance.Invert();
   local = 0.0;
   local.SetSubMatrix(0, compliance);
   local(3, 3) = local(4, 4) = constants.shear_rtheta;
   local(5, 5) = constants.young_r / (2.0 * (1.0 + constants.poisson_rz));
}

void TransverselyIsotropic::GetStiffness(ElementTransformation &trans,
                                         const IntegrationPoint &ip,
                                         DenseMatrix &stiffness) const
{
   DenseMatrix map;
   GetStrainMap(frame.GetAxes({trans, ip}), map);
   DenseMatrix half(6);
   Mult(local, map, half);
   stiffness.SetSize(6);
   MultAtB(map, half, stiffness);
}

} // namespace synovia
