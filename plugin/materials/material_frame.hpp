#pragma once

#include "synovia/general/point3.hpp"
#include "synovia/materials/material_point.hpp"
#include "synovia/materials/tensor3.hpp"

#include <string>

namespace synovia
{

/// The orthonormal axes r, theta, z of an anisotropic material at each point.
class MaterialFrame
{
public:
   virtual ~MaterialFrame() = default;

   /// The axes at a point, as columns.
   virtual Tensor3<> GetAxes(const MaterialPoint &point) const = 0;

   /// Why there are no axes in an element; empty if there are.
   virtual std::string Validate(mfem::ElementTransformation &) const
   {
      return "";
   }
};

/// Axes with these columns.
Tensor3<> AxesOf(const Point3 &r, const Point3 &theta, const Point3 &z);

/// Axes whose theta is the direction of a vector that isn't zero; r and z are
/// any directions perpendicular to it.
Tensor3<> AxesAlong(const Point3 &theta);

/// The same axes everywhere; theta is given, r and z are perpendicular to it.
class CartesianFrame : public MaterialFrame
{
public:
   /// @a theta has any length; throws Error if that is zero.
   explicit CartesianFrame(const Point3 &theta);

   Tensor3<> GetAxes(const MaterialPoint &) const override { return axes; }

private:
   Tensor3<> axes;
};

/// Axes around a straight line: z along it, r away from it, theta around it.
class CylindricalFrame : public MaterialFrame
{
public:
   /// A point on the line (length) and its direction, of any length; throws
   /// Error if that is zero.
   CylindricalFrame(const Point3 &origin, const Point3 &axis);

   Tensor3<> GetAxes(const MaterialPoint &point) const override;
   /// On the line r and theta are undefined: it must not come near an element.
   std::string Validate(mfem::ElementTransformation &trans) const override;

private:
   /// The vector to a point from the nearest one on the line.
   Point3 FromLine(const mfem::Vector &point) const;

   Point3 origin;
   Point3 axis;
};

} // namespace synovia
