#pragma once

#include "synovia/feb/feb_axes.hpp"

#include <array>

namespace synovia
{

/// The frame that the laws of a material refer to, found while they are read:
/// uniform axes, axes around a line along z, or where directions differ from
/// element to element, one direction for each of them.
class FebFrame
{
public:
   /// Borrows what @a elements borrows. @a field is the name of directions of
   /// elements.
   FebFrame(const FebInput &material, const FebElements &elements,
            const std::string &field);

   const FebElements &Elements() const { return elements; }

   /// The components along r, theta and z of a direction in the axes of the
   /// material. @a law stops where the frame can't have it as well as those
   /// that it has already.
   Point3 Components(const FebInput &law, const FebDirection &direction);
   /// For each of the material's axes which of r, theta and z (0 to 2) is
   /// parallel to it. @a law stops if one has none.
   std::array<int, 3> Places(const FebInput &law);

   /// When all laws have been read.
   const FrameCase &Case() const { return frame; }
   /// The directions of elements; none where the frame has others.
   const FebElementData::Vectors &Field() const { return field; }

private:
   bool HasUniformAxes() const { return !axes.of_element; }
   /// Along the frame's axes, of a vector in those of the material.
   Point3 InFrame(const Point3 &local) const;
   Point3 AroundLine(const FebInput &law, const FebDirection &direction);
   Point3 OfElements(const FebInput &law, const FebDirection &direction);
   bool Conflicts(const FebInput &law, bool conflict) const;

   FebElements elements;
   FebAxes axes;
   std::string name;
   FrameCase frame;
   FebElementData::Vectors field;
   /// What directions refer to so far.
   enum class Use
   {
      none,
      axes,
      line_of_fibers,
      field
   } use = Use::none;
};

} // namespace synovia
