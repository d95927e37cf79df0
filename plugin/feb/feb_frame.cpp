#include "synovia/feb/feb_frame.hpp"
#include "synovia/feb/feb_directions.hpp"
#include "synovia/materials/material_frame.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr real_t same_direction = 1e-12;

Point3 Column(const Tensor3<> &axes, int j)
{
   return {axes[0][j], axes[1][j], axes[2][j]};
}

Point3 InSpace(const Tensor3<> &axes, const Point3 &local)
{
   Point3 vector{{0.0, 0.0, 0.0}};
   for (int j = 0; j < 3; j++)
   {
      vector = Sum(vector, local[j], Column(axes, j));
   }
   return vector;
}
} // namespace

FebFrame::FebFrame(const FebInput &material, const FebElements &elements_,
                   const std::string &field_)
   : elements(elements_), axes(ReadAxes(material, elements)), name(field_)
{
   if (axes.cylinder)
   {
      frame = *axes.cylinder;
   }
   else if (HasUniformAxes())
   {
      frame.axis = Column(axes.axes, 0);
   }
}

Point3 FebFrame::InFrame(const Point3 &local) const
{
   const Point3 vector = InSpace(axes.axes, local);
   if (axes.cylinder)
   {
      return vector;
   }
   const Tensor3<> of_frame = AxesAlong(frame.axis);
   Point3 components;
   for (int j = 0; j < 3; j++)
   {
      components[j] = Dot(Column(of_frame, j), vector);
   }
   return components;
}

bool FebFrame::Conflicts(const FebInput &law, bool conflict) const
{
   if (conflict)
   {
      law.Stop("where directions differ from element to element a material has "
               "one direction");
   }
   return conflict;
}

Point3 FebFrame::Components(const FebInput &law, const FebDirection &direction)
{
   const bool in_axes = HasUniformAxes() || axes.cylinder;
   if (in_axes && !direction.of_element)
   {
      Conflicts(law, use == Use::field || use == Use::line_of_fibers);
      use = Use::axes;
      return InFrame(direction.direction);
   }
   const bool in_space = !axes.cylinder && HasUniformAxes() &&
                         InSpace(axes.axes, x_axis) == x_axis &&
                         InSpace(axes.axes, y_axis) == y_axis;
   return direction.cylinder && in_space && use != Use::field
             ? AroundLine(law, direction)
             : OfElements(law, direction);
}

Point3 FebFrame::AroundLine(const FebInput &law, const FebDirection &direction)
{
   Conflicts(law,
             use == Use::axes || (use == Use::line_of_fibers &&
                                  frame.origin != direction.cylinder->origin));
   use = Use::line_of_fibers;
   frame = *direction.cylinder;
   return direction.direction;
}

Point3 FebFrame::OfElements(const FebInput &law, const FebDirection &direction)
{
   FebElementData::Vectors found;
   real_t largest = 0.0;
   for (const int part : elements.parts)
   {
      for (const FebCell &cell : elements.mesh.parts[part].cells)
      {
         const Point3 local = direction.of_element
                                 ? direction.of_element(cell, part)
                                 : direction.direction;
         const Point3 vector = InSpace(
            axes.of_element ? axes.of_element(cell, part) : axes.axes, local);
         found[cell.number] = vector;
         if (use == Use::field)
         {
            largest = std::max(
               largest, Length(Sum(vector, -1.0, field.at(cell.number))));
         }
      }
   }
   if (!Conflicts(law, use == Use::axes || use == Use::line_of_fibers ||
                          largest > same_direction))
   {
      use = Use::field;
      field = found;
      frame = FrameCase();
      frame.type = FrameType::field;
      frame.name = name;
   }
   if (direction.at_centers || (axes.of_element && axes.at_centers))
   {
      law.Approximate("directions are those at the centers of the elements");
   }
   return y_axis;
}

std::array<int, 3> FebFrame::Places(const FebInput &law)
{
   std::array<int, 3> places{{0, 1, 2}};
   if (!HasUniformAxes() && !axes.cylinder)
   {
      law.Stop("axes that differ from element to element are only known as "
               "one direction");
      return places;
   }
   for (int a = 0; a < 3; a++)
   {
      Point3 local{{0.0, 0.0, 0.0}};
      local[a] = 1.0;
      FebDirection direction;
      direction.direction = local;
      const Point3 parts = Components(law, direction);
      bool found = false;
      for (int b = 0; b < 3; b++)
      {
         if (std::abs(std::abs(parts[b]) - 1.0) < same_direction)
         {
            places[a] = b;
            found = true;
         }
      }
      if (!found)
      {
         law.Stop("the second and third material axis must be along axes of "
                  "space");
         return {{0, 1, 2}};
      }
   }
   return places;
}

} // namespace synovia
