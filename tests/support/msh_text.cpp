#include "support/msh_text.hpp"

#include <algorithm>
#include <sstream>

namespace synovia
{

namespace
{

// Calls f(i, j, k) for all below the numbers.
void ForGrid(int nx, int ny, int nz,
             const std::function<void(int, int, int)> &f)
{
   for (int k = 0; k < nz; k++)
   {
      for (int j = 0; j < ny; j++)
      {
         for (int i = 0; i < nx; i++)
         {
            f(i, j, k);
         }
      }
   }
}

} // namespace

MshText::MshText(int nx_, int ny_, int nz_) : nx(nx_), ny(ny_), nz(nz_)
{
   region = [](int, int, int) { return 10; };
   left_handed = [](int, int, int) { return false; };
   position = [](int i, int j, int k) {
      return std::array<double, 3>{1.0 * i, 1.0 * j, 1.0 * k};
   };
}

int MshText::Node(int i, int j, int k) const
{
   return first_node + i + (nx + 1) * (j + (ny + 1) * k);
}

std::string MshText::Text() const
{
   std::ostringstream nodes;
   int node_count = 0;
   const auto add_node = [&](int i, int j, int k)
   {
      const auto at = position(i, j, k);
      nodes << Node(i, j, k) << ' ' << at[0] << ' ' << at[1] << ' ' << at[2]
            << '\n';
      node_count++;
   };
   ForGrid(nx + 1, ny + 1, nz + 1, add_node);
   if (stray_node)
   {
      nodes << 1 << " 1e9 0 0\n";
      node_count++;
   }

   std::ostringstream elements;
   int element_count = 0;
   const auto add = [&](int type, int physical, const std::vector<int> &corners)
   {
      elements << first_element + element_count++ << ' ' << type << " 2 "
               << physical << " 1";
      for (const int corner : corners)
      {
         elements << ' ' << corner;
      }
      elements << '\n';
   };
   constexpr int hexahedron = 5;
   constexpr int quadrangle = 3;
   const auto add_cell = [&](int i, int j, int k)
   {
      std::vector<int> c = {Node(i, j, k),
                            Node(i + 1, j, k),
                            Node(i + 1, j + 1, k),
                            Node(i, j + 1, k),
                            Node(i, j, k + 1),
                            Node(i + 1, j, k + 1),
                            Node(i + 1, j + 1, k + 1),
                            Node(i, j + 1, k + 1)};
      const std::vector<std::pair<bool, std::vector<int>>> faces = {
         {i == 0, {c[0], c[3], c[7], c[4]}},
         {i == nx - 1, {c[1], c[2], c[6], c[5]}},
         {j == 0, {c[0], c[1], c[5], c[4]}},
         {j == ny - 1, {c[3], c[2], c[6], c[7]}},
         {k == 0, {c[0], c[1], c[2], c[3]}},
         {k == nz - 1, {c[4], c[5], c[6], c[7]}}};
      for (const auto &face : faces)
      {
         if (face.first)
         {
            add(quadrangle, 1, face.second);
         }
      }
      if (left_handed(i, j, k))
      {
         std::rotate(c.begin(), c.begin() + 4, c.end());
      }
      add(hexahedron, region(i, j, k), c);
   };
   ForGrid(nx, ny, nz, add_cell);

   std::ostringstream text;
   text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n"
        << node_count << '\n'
        << nodes.str() << "$EndNodes\n$Elements\n"
        << element_count << '\n'
        << elements.str() << "$EndElements\n";
   return text.str();
}

std::string MirrorMsh(const std::string &text)
{
   std::istringstream lines(text);
   std::ostringstream mirrored;
   std::string line;
   bool in_nodes = false;
   while (std::getline(lines, line))
   {
      in_nodes = line == "$Nodes" || (in_nodes && line != "$EndNodes");
      // Only lines of coordinates have three numbers there.
      std::istringstream words(line);
      double x = 0.0;
      double y = 0.0;
      double z = 0.0;
      double more = 0.0;
      if (in_nodes && words >> x >> y >> z && !(words >> more))
      {
         mirrored.precision(17);
         mirrored << -x << ' ' << y << ' ' << z << '\n';
      }
      else
      {
         mirrored << line << '\n';
      }
   }
   return mirrored.str();
}

} // namespace synovia
