#pragma once

#include <string>
#include <vector>

namespace synovia
{

/// How gmsh has saved a mesh.
struct GmshFormat
{
   double version = 4.1;
   bool binary = false;
   int order = 1;
   /// Without the nodes inside faces and elements.
   bool serendipity = false;
};

/// The path of a mesh that gmsh_models.py makes before the tests, by the name
/// of its model. Throws Error if it is missing. A test with such meshes has the
/// line "// fixtures: gmsh_meshes" at its head.
std::string GmshMesh(const std::string &model,
                     const GmshFormat &format = GmshFormat());

/// A point of an element as gmsh has it.
struct GmshPoint
{
   int element = 0;
   double place[3] = {0.0, 0.0, 0.0};
};

/// Points of the elements of a curved model: of each element those with
/// gmsh_local_points, in that order.
std::vector<GmshPoint> GmshPoints(const std::string &model,
                                  const GmshFormat &format);

/// In gmsh's tetrahedron, prism, hexahedron and pyramid alike.
constexpr double gmsh_local_points[2][3] = {{0.2, 0.1, 0.3}, {0.5, 0.25, 0.2}};

} // namespace synovia
