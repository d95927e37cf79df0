#include "synovia/mesh/contact_partitioning.hpp"

#include <metis.h>

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
// What a face of the destination costs, in elements of finite deformation, and
// what it costs to have its partner on another rank, in faces between elements.
constexpr idx_t contact_cost = 4;
constexpr idx_t parting_cost = 4;

/// A boundary element: the volume element behind it, and its center.
struct Face
{
   int element;
   Point3 center;
};

std::vector<Face> FindFaces(Mesh &mesh, const NameTable &boundaries,
                            const std::vector<std::string> &names)
{
   std::vector<int> attributes;
   for (const std::string &name : names)
   {
      const auto found = boundaries.find(name);
      if (found != boundaries.end())
      {
         attributes.insert(attributes.end(), found->second.begin(),
                           found->second.end());
      }
   }
   std::vector<Face> faces;
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      if (std::find(attributes.begin(), attributes.end(),
                    mesh.GetBdrAttribute(i)) == attributes.end())
      {
         continue;
      }
      Face face;
      int info = 0;
      mesh.GetBdrElementAdjacentElement(i, face.element, info);
      Vector center;
      mesh.GetBdrElementTransformation(i)->Transform(
         Geometries.GetCenter(mesh.GetBdrElementGeometry(i)), center);
      std::copy(center.begin(), center.end(), face.center.begin());
      faces.push_back(face);
   }
   return faces;
}

/// The graph that METIS cuts.
class ElementGraph
{
public:
   explicit ElementGraph(Mesh &mesh)
      : weights(mesh.GetNE(), 1), neighbors(mesh.GetNE())
   {
      const Table &table = mesh.ElementToElementTable();
      for (int e = 0; e < mesh.GetNE(); e++)
      {
         for (int k = 0; k < table.RowSize(e); k++)
         {
            neighbors[e].emplace_back(table.GetRow(e)[k], 1);
         }
      }
   }

   /// Each face of the destination and the nearest one of the source.
   void AddContact(const std::vector<Face> &source,
                   const std::vector<Face> &destination)
   {
      if (source.empty())
      {
         return;
      }
      // METIS has a real_t of its own.
      KDTree<int, mfem::real_t, 3> tree;
      for (std::size_t i = 0; i < source.size(); i++)
      {
         tree.AddPoint(source[i].center.data(), static_cast<int>(i));
      }
      tree.Sort();
      for (const Face &face : destination)
      {
         const int partner =
            source[tree.FindClosestPoint(face.center.data())].element;
         weights[face.element] += contact_cost;
         if (partner != face.element)
         {
            Join(face.element, partner);
            Join(partner, face.element);
         }
      }
   }

   /// A part for each element.
   std::vector<int> Cut(int parts)
   {
      std::vector<idx_t> begins{0};
      std::vector<idx_t> ends;
      std::vector<idx_t> end_weights;
      for (const auto &row : neighbors)
      {
         for (const auto &[element, weight] : row)
         {
            ends.push_back(element);
            end_weights.push_back(weight);
         }
         begins.push_back(static_cast<idx_t>(ends.size()));
      }
      idx_t count = static_cast<idx_t>(weights.size());
      idx_t constraints = 1;
      idx_t part_count = parts;
      idx_t cut = 0;
      std::vector<idx_t> part(weights.size(), 0);
      // METIS' manual: bisection is better for few parts.
      constexpr int few = 8;
      const auto partition =
         parts <= few ? METIS_PartGraphRecursive : METIS_PartGraphKway;
      const int status =
         partition(&count, &constraints, begins.data(), ends.data(),
                   weights.data(), nullptr, end_weights.data(), &part_count,
                   nullptr, nullptr, nullptr, &cut, part.data());
      MFEM_VERIFY(status == METIS_OK, "METIS could not partition the mesh");
      return std::vector<int>(part.begin(), part.end());
   }

private:
   void Join(int from, int to)
   {
      auto &row = neighbors[from];
      const auto found =
         std::find_if(row.begin(), row.end(),
                      [to](const auto &end) { return end.first == to; });
      if (found == row.end())
      {
         row.emplace_back(to, parting_cost);
      }
      else
      {
         found->second += parting_cost;
      }
   }

   std::vector<idx_t> weights;
   /// Of each element, and what it costs to cut them off.
   std::vector<std::vector<std::pair<idx_t, idx_t>>> neighbors;
};

bool EachHasSome(const std::vector<int> &part, int parts)
{
   std::vector<bool> has(parts, false);
   for (const int p : part)
   {
      has[p] = true;
   }
   return std::find(has.begin(), has.end(), false) == has.end();
}
} // namespace

std::vector<int> PartitionByContact(Mesh &serial, const NameTable &boundaries,
                                    const std::vector<FacingSurfaces> &contacts,
                                    int ranks)
{
   if (ranks == 1)
   {
      return std::vector<int>(serial.GetNE(), 0);
   }
   ElementGraph graph(serial);
   for (const FacingSurfaces &contact : contacts)
   {
      graph.AddContact(FindFaces(serial, boundaries, contact.source),
                       FindFaces(serial, boundaries, contact.destination));
   }
   std::vector<int> part = graph.Cut(ranks);
   if (!EachHasSome(part, ranks))
   {
      // With few elements a rank MFEM sees to it that each gets one.
      const std::unique_ptr<int[]> others(serial.GeneratePartitioning(ranks));
      part.assign(others.get(), others.get() + serial.GetNE());
   }
   return part;
}

} // namespace synovia
