#pragma once

#include "support/temporary_directory.hpp"

#include <functional>
#include <string>
#include <vector>

namespace synovia
{

/// How gmsh saves a mesh.
struct GmshFormat
{
   double version = 4.1;
   bool binary = false;
   int order = 1;
   /// Without the nodes inside faces and elements.
   bool serendipity = false;
};

/// Collective: rank 0 calls @a build, which fills gmsh's current model, meshes
/// it unless @a build has, and saves it. Returns the path of the file.
std::string SaveWithGmsh(const TemporaryDirectory &directory,
                         const GmshFormat &format,
                         const std::function<void()> &build);

/// The contents of a file that SaveWithGmsh() has written. Collective.
std::string SavedText(const TemporaryDirectory &directory,
                      const GmshFormat &format,
                      const std::function<void()> &build);

enum class Cells
{
   tetrahedra,
   hexahedra,
   prisms
};

/// @{
/// Models for SaveWithGmsh(), to be called by build.

/// The box [0,1] x [0,2] x [0,3] of a few elements: volume "box", surfaces
/// "bottom", "top" (z = 3) and "sides".
void BuildBox(Cells cells);

/// The cylinder of radius 1 and height 2 with elements of about @a size: volume
/// "cylinder", surfaces "bottom", "top" and "mantle".
void BuildCylinder(Cells cells, double size);

/// The ball of radius 1 around the origin: volume "ball", surface "sphere".
void BuildBall(double size);

/// The unit cube of six pyramids that meet in its center: volume "cube".
void BuildPyramids();
/// @}

/// Makes a physical group.
void Group(int dimension, const std::vector<int> &entities, int tag,
           const std::string &name);

} // namespace synovia
