#pragma once

#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"

namespace synovia
{

/// The direction of fibers in the undeformed body: a unit vector that is the
/// same everywhere in the axes of a frame.
class FiberDirection
{
public:
   /// Along theta. Borrows @a frame. Not explicit: laws of fibers take a frame
   /// for this.
   FiberDirection(const MaterialFrame &frame);
   /// Along r, theta and z by the @a components, of any length. Throws Error if
   /// it is zero. Borrows @a frame.
   FiberDirection(const MaterialFrame &frame, const Point3 &components);
   /// As the vector "direction" of a law says.
   explicit FiberDirection(const LawArguments &from);

   Vector3<> operator()(const MaterialPoint &point) const
   {
      return Product(frame.GetAxes(point), components);
   }
   /// As MaterialFrame.
   std::string Validate(mfem::ElementTransformation &trans) const
   {
      return frame.Validate(trans);
   }

private:
   const MaterialFrame &frame;
   Vector3<> components;
};

/// What case files say of a law of fibers: its parameters, and "direction",
/// which is theta unless given.
LawDescription DescribeFibers(const std::string &name,
                              const std::string &meaning,
                              const std::vector<LawParameter> &parameters);

} // namespace synovia
