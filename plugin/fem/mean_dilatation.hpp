#pragma once

#include "synovia/fem/body_element.hpp"
#include "synovia/materials/solid_law.hpp"

#include <vector>

namespace synovia
{

/// The effective stress in an element whose solid sees one change of volume,
/// the mean over the undeformed element, so that elements of order 1 don't lock
/// where the solid is nearly incompressible:
///
///     P(F, theta)  from  W((theta / J)^(1/3) F),  theta = int J / int 1
///
/// (J. C. Simo, R. L. Taylor, K. S. Pister, Comput. Methods Appl. Mech. Eng.
/// 51:177-208, 1985). Shape functions of order 2 and more need no such cure.
class MeanDilatation
{
public:
   /// Sets the stresses at all points of the element that @a element is set to;
   /// false if its state is one that the law does not allow.
   bool Evaluate(BodyElement &element, const SolidLaw &solid);
   /// The same with their derivatives.
   bool Linearize(BodyElement &element, const SolidLaw &solid);

   /// First Piola-Kirchhoff stress that works on the change of F at a point.
   const Tensor3<> &Stress(int point) const { return stresses[point]; }
   /// Its derivative by F at the same point, with all else kept.
   const Tangent3 &Tangent(int point) const { return tangents[point]; }
   /// Adds what the points' stresses change with the deformation of all others,
   /// dofs component by component. After Linearize().
   void AddCoupling(BodyElement &element, mfem::DenseMatrix &stiffness);

private:
   /// Sets @a volume and @a dilatation; false if a point is inverted.
   bool FindMean(const BodyElement &element);
   /// Sets the stress at a point, and the derivatives unless there is no
   /// @a tangent of the law, but for what the mean pressure adds.
   bool EvaluatePoint(BodyElement &element, const SolidLaw &solid, int point,
                      Tangent3 *tangent);

   mfem::real_t volume = 0.0;
   /// theta
   mfem::real_t dilatation = 1.0;
   /// The mean of dW/dtheta: the pressure of the solid, positive in tension.
   mfem::real_t mean_pressure = 0.0;
   std::vector<Tensor3<>> stresses;
   std::vector<Tangent3> tangents;
   /// dP/dtheta and d(dW/dtheta)/dF at the points.
   std::vector<Tensor3<>> stress_changes;
   std::vector<Tensor3<>> pressure_changes;
   /// int d2W/dtheta2
   mfem::real_t curvature = 0.0;
};

} // namespace synovia
