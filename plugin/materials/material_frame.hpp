#pragma once

#include "synovia/general/point3.hpp"

#include <string>

namespace synovia
{

/// The axes r, theta, z of an anisotropic material, orthonormal, in space.
class MaterialFrame
{
public:
   virtual ~MaterialFrame() = default;

   /// Sets the 3 x 3 matrix with the axes as columns at a point of space.
   virtual void GetAxes(const mfem::Vector &point,
                        mfem::DenseMatrix &axes) const = 0;

   /// Says what is wrong with the frame in an element; empty if nothing is.
   virtual std::string Validate(mfem::ElementTransformation &) const
   {
      return "";
   }
};

/// The same axes everywhere; theta is given, r and z are across it.
class CartesianFrame : public MaterialFrame
{
public:
   /// @a theta has any length; throws Error if that is zero.
   explicit CartesianFrame(const Point3 &theta);

   void GetAxes(const mfem::Vector &point,
                mfem::DenseMatrix &axes) const override;

private:
   mfem::DenseMatrix fixed_axes;
};

/// Axes around a straight line: z along it, r away from it, theta around it.
class CylindricalFrame : public MaterialFrame
{
public:
   /// A point on the line (length) and its direction, of any length; throws
   /// Error if that is zero.
   CylindricalFrame(const Point3 &origin, const Point3 &axis);

   void GetAxes(const mfem::Vector &point,
                mfem::DenseMatrix &axes) const override;
   /// On the line r and theta mean nothing: it must not come near an element.
   std::string Validate(mfem::ElementTransformation &trans) const override;

private:
   /// The vector to a point from the nearest one on the line.
   Point3 FromLine(const mfem::Vector &point) const;

   Point3 origin;
   Point3 axis;
};

} // namespace synovia
