#pragma once

#include <string>
#include <vector>

namespace synovia
{

enum class LogSubject
{
   nodes,
   elements,
   rigid_bodies
};

/// A table of values in each step, under the names and with the signs that the
/// log file of FEBio has:
///
///     nodes (corners of elements)
///       x, y, z        where it is (length)
///       ux, uy, uz     displacement (length)
///       Rx, Ry, Rz     force of the body on its support where a displacement
///                      is prescribed, else on what loads and touches it: the
///                      reverse of those forces (force)
///       p              fluid pressure (stress)
///     elements, averages of their Gauss points
///       x, y, z        where it is (length)
///       sx, sy, sz, sxy, syz, sxz; s1, s2, s3
///                      total stress in space and its principal values,
///                      largest first (stress)
///       Ex, Ey, Ez, Exy, Eyz, Exz; E1, E2, E3
///                      Green-Lagrange strain, in small deformation the linear
///                      one, likewise
///       Fxx, Fxy, ..., Fzz; J
///                      deformation gradient and its determinant
///       p; wx, wy, wz  fluid pressure (stress); flux relative to the solid
///                      (length / time)
///     rigid bodies
///       x, y, z        where the reference point is (length)
///       qx, qy, qz, qw rotation as a quaternion
///       Fx, Fy, Fz; Mx, My, Mz
///                      force and moment on the body from outside of it
///                      (force, force x length)
struct LogDefinition
{
   /// In logs/ of the output directory.
   std::string file;
   LogSubject of = LogSubject::nodes;
   std::vector<std::string> data;
   /// Of nodes or elements in the mesh file; empty: all that the rest allows.
   std::vector<int> numbers;
   /// Whose nodes.
   std::vector<std::string> surfaces;
   /// Whose elements, or the nodes of these.
   std::vector<std::string> regions;
   /// By name; empty: all.
   std::vector<std::string> rigid_bodies;
   /// Between columns.
   std::string delimiter = " ";
};

/// What there is to log of them, in the order of the list above.
const std::vector<std::string> &LogData(LogSubject subject);

} // namespace synovia
