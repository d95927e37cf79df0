#pragma once

#include "synovia/general/point3.hpp"

namespace synovia
{

// A rotation vector is along the axis of a rotation and as long as its angle
// (rad), right-handed. Its exponential is the rotation, without the locks of
// successive angles; increments of the vector and the spin that they make
// differ, unless they have the same axis.

/// R = exp([theta]x) (Rodrigues).
mfem::DenseMatrix RotationMatrix(const Point3 &theta);

/// D with spin = D d(theta), where dR = [spin]x R. Singular at full turns but
/// none.
mfem::DenseMatrix SpinMatrix(const Point3 &theta);

/// Derivative of D^T a with respect to theta, @a a being constant.
mfem::DenseMatrix SpinTransposeDerivative(const Point3 &theta, const Point3 &a);

/// The vector of the same rotation by at most half a turn.
Point3 Shortened(const Point3 &theta);

/// [a]x, by which a x b = [a]x b.
mfem::DenseMatrix CrossMatrix(const Point3 &a);

/// A a, and A^T a.
Point3 Times(const mfem::DenseMatrix &matrix, const Point3 &a);
Point3 TransposeTimes(const mfem::DenseMatrix &matrix, const Point3 &a);

} // namespace synovia
