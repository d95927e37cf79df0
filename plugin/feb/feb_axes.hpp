#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/feb/feb_element_data.hpp"

#include <functional>
#include <set>

namespace synovia
{

/// The elements of a material, for what differs from one to the other. Borrows
/// mesh and data.
struct FebElements
{
   const FebMesh &mesh;
   const FebElementData &data;
   /// Places of the parts that are of the material.
   std::vector<int> parts;

   /// Whether there is something for one of them.
   template <typename Entries>
   bool AreIn(const Entries &entries) const
   {
      for (const int part : parts)
      {
         for (const FebCell &cell : mesh.parts[part].cells)
         {
            if (entries.count(cell.number) > 0)
            {
               return true;
            }
         }
      }
      return false;
   }
   /// The mean of the corners.
   Point3 Center(const FebCell &cell, int part) const;
};

/// Axes of a material, in columns.
struct FebAxes
{
   /// In space, or along r, theta and z of the cylinder, if there is one.
   Tensor3<> axes = IdentityTensor();
   std::optional<FrameCase> cylinder{};
   /// In space, of a cell of a part, where they are others in each element;
   /// else empty.
   std::function<Tensor3<>(const FebCell &, int part)> of_element{};
   /// Whether these are those of the middle of an element.
   bool at_centers = false;
};

/// Those of the element mat_axis in @a material, or those of space if there is
/// none, or those that the section MeshData has.
FebAxes ReadAxes(const FebInput &material, const FebElements &elements);

/// A direction in the axes of a material; likewise.
struct FebDirection
{
   Point3 direction{{1.0, 0.0, 0.0}};
   std::optional<FrameCase> cylinder{};
   std::function<Point3(const FebCell &, int part)> of_element{};
   bool at_centers = false;
};

/// The unit vector that the element fiber in @a law describes, or the section
/// MeshData; the first axis if there is none.
FebDirection ReadFiber(const FebInput &law, const FebElements &elements);

} // namespace synovia
