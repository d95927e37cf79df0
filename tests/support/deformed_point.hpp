#pragma once

#include "synovia/materials/material_point.hpp"
#include "synovia/materials/tensor3.hpp"

#include <functional>

namespace synovia
{

/// A point of an element, for laws that need one: the middle of a unit cube.
class AnyPoint
{
public:
   AnyPoint();
   MaterialPoint Get() { return {trans, ip}; }

private:
   mfem::Mesh mesh;
   mfem::ElementTransformation &trans;
   const mfem::IntegrationPoint &ip;
};

/// Symmetric tensors have their components in this order.
constexpr int voigt_pairs[6][2] = {{0, 0}, {1, 1}, {2, 2},
                                   {0, 1}, {1, 2}, {0, 2}};

/// A deformation gradient with stretches, shears and a rotation, det F
/// = 1.0025, and a direction: those of tests/reference/law_oracles.csv.
Tensor3<> SomeDeformation();
Vector3<> SomeDirection();
/// A rotation about no axis of the coordinates.
Tensor3<> SomeRotation();

/// A B^T / det B, as Cauchy's stress is made of that of Piola and Kirchhoff.
Tensor3<> PushedForward(const Tensor3<> &A, const Tensor3<> &B);

/// What a law of the deformation gradient gives: a tensor and, if asked, its
/// derivative; false where there is none.
using TensorFunction =
   std::function<bool(const Tensor3<> &F, Tensor3<> &value, Tangent3 *tangent)>;

/// Compares the derivative with central differences of the value, relative to
/// its largest entry, and the value with that without derivative.
void CheckDerivative(const TensorFunction &function, const Tensor3<> &F);

/// Whether the largest difference of two tensors is below @a tolerance times
/// the largest entry of the first.
bool AreClose(const Tensor3<> &a, const Tensor3<> &b, mfem::real_t tolerance);

} // namespace synovia
