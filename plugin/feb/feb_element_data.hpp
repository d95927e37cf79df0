#pragma once

#include "synovia/feb/feb_mesh.hpp"
#include "synovia/materials/tensor3.hpp"

namespace synovia
{

/// What the section MeshData has of elements, by their numbers.
struct FebElementData
{
   using Vectors = std::unordered_map<long long, Point3>;

   /// Axes of materials, in columns.
   std::unordered_map<long long, Tensor3<>> axes;
   /// Directions of fibers, of any length but 0.
   Vectors fibers;
   /// Vectors under a name, which fibers may refer to.
   std::map<std::string, Vectors> maps;
};

/// Reads the section of @a root, if it is there, for the elements of @a mesh.
FebElementData ReadElementData(const FebInput &root, const FebMesh &mesh);

/// The numbers of the elements of a set: the elements of this name, or those
/// of the ElementSet in the section of the mesh; empty if there is none.
std::vector<long long> ElementsOfSet(const std::string &name,
                                     const FebInput &root, const FebMesh &mesh);

/// The unit vector along @a vector; the first axis, and @a where stops, if it
/// is zero.
Point3 UnitVector(const Point3 &vector, const FebInput &where);

/// The tensor with these columns.
Tensor3<> InColumns(const std::array<Point3, 3> &columns);

/// Axes, in columns: the first along @a a, the third across @a a and @a d.
Tensor3<> AxesAcross(const Point3 &a, const Point3 &d, const FebInput &where);

/// Three numbers; the first axis, and @a from stops, if there are others.
Point3 ReadVector(const FebInput &from);

} // namespace synovia
