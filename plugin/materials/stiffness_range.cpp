#include "synovia/materials/stiffness_range.hpp"
#include "synovia/general/symmetric_eigenvalues.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr int size = 6;
} // namespace

StiffnessRange RangeOfStiffness(DenseMatrix stiffness)
{
   // With shear strains times sqrt(2) the tensors' product is the vectors'.
   for (int i = 0; i < size; i++)
   {
      for (int j = 0; j < size; j++)
      {
         stiffness(i, j) *=
            (i < 3 ? 1.0 : std::sqrt(2.0)) * (j < 3 ? 1.0 : std::sqrt(2.0));
      }
   }
   const Vector eigenvalues = SymmetricEigenvalues(stiffness);
   return {eigenvalues[0], eigenvalues[size - 1]};
}

StiffnessRange RangeOfStiffness(const SolidLaw &law,
                                ElementTransformation &trans)
{
   const IntegrationPoint &center =
      Geometries.GetCenter(trans.GetGeometryType());
   trans.SetIntPoint(&center);
   DenseMatrix stiffness;
   law.GetStiffness(trans, center, stiffness);
   return RangeOfStiffness(stiffness);
}

} // namespace synovia
