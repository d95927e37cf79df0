#pragma once

#include "synovia/feb/feb_mesh.hpp"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace synovia
{

/// The name without what can't be in columns of the history and in names of
/// files.
std::string PlainName(std::string name);

/// Surfaces of a case, made from sets of nodes and of facets of a model.
class FebSurfaces
{
public:
   /// A named set of outer faces.
   struct Group
   {
      std::string name;
      std::vector<int> faces;
   };

   /// Takes those parts into account whose places @a deformable and @a rigid
   /// have. Borrows @a mesh.
   FebSurfaces(const FebMesh &mesh, const std::set<int> &deformable,
               const std::set<int> &rigid);

   /// Whether the nodes of this set, as OfNodes() understands it, make up whole
   /// outer faces.
   bool AreFaces(const std::string &set);
   /// The name of the surface with the nodes of this set, which may also be
   /// given as "@surface:NAME"; empty, and @a where stops, if there is no such
   /// set, or if its nodes don't make up whole outer faces.
   /// What is rigid has no conditions of its own, and is left out.
   std::string OfNodes(const std::string &set, const FebInput &where);
   /// Likewise for the surface of that name.
   std::string OfFacets(const std::string &surface, const FebInput &where);

   const std::vector<Group> &Groups() const { return groups; }
   /// The corners of an outer face.
   const std::vector<int> &Corners(int face) const { return faces[face]; }
   /// Whether a node belongs to an element that is taken into account.
   bool IsUsed(int node) const { return used[node]; }
   /// For each corner of the faces of a surface of that name in the case the
   /// integral of its linear shape function (area).
   std::map<int, mfem::real_t> NodalAreas(const std::string &name) const;
   /// Nodes of a set as OfNodes() understands it; null if there is none.
   const std::vector<int> *FindNodes(const std::string &set);

private:
   /// The outer faces whose nodes are all among these; @a left are those on no
   /// such face.
   std::vector<int> FacesOf(const std::vector<int> &nodes,
                            std::vector<bool> &left) const;
   std::string Add(const std::string &key, const std::string &name,
                   const std::vector<int> &members);
   /// Faces of a surface, without rigid ones if these don't count; none, and
   /// @a where stops, if facets are no outer faces.
   std::vector<int> Members(const std::string &surface, bool with_rigid,
                            const FebInput &where);
   std::string Unused(const std::string &name) const;

   const FebMesh &mesh;
   std::vector<std::vector<int>> faces;
   /// All nodes of each face, with those between its corners.
   std::vector<std::vector<int>> face_nodes;
   std::map<std::vector<int>, int> by_corners;
   std::vector<bool> used;
   /// Nodes of deformable parts, and which faces are rigid ones'.
   std::vector<bool> deforms;
   std::vector<bool> is_rigid;
   std::vector<Group> groups;
   /// Names of groups by what they were made of.
   std::map<std::string, std::string> made;
   std::map<std::string, std::vector<int>> nodes_of_surfaces;
};

} // namespace synovia
