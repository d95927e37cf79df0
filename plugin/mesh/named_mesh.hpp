#pragma once

#include "synovia/general/point3.hpp"
#include "synovia/mesh/rigid_shape.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace synovia
{

/// Names and the attributes that each of them stands for, ascending. A name
/// without attributes is known but has no elements.
using NameTable = std::map<std::string, std::vector<int>>;

/// Vectors of elements that a mesh file has under one name.
struct ElementVectors
{
   /// One for each element of this rank; zero where the file has none.
   std::vector<Point3> vectors;
   /// The elements' numbers in the file.
   std::vector<long long> numbers;
};

/// The numbers that a mesh file has for its elements and vertices; none where
/// the mesh is of no file, or refined.
struct FileNumbers
{
   /// One for each element of this rank.
   std::vector<long long> elements;
   /// One for each vertex of this rank.
   std::vector<long long> vertices;
   /// On all ranks alike.
   bool known = false;
};

/// A distributed mesh whose regions and boundaries go by name.
///
/// All bodies of a problem are regions of one mesh; they need not touch. A name
/// may stand for several attributes and an attribute may have several names. A
/// name that is a number, such as "3", stands for that physical tag.
class NamedMesh
{
public:
   /// Takes the mesh. The tables must be the same on all ranks. The names are
   /// entered in the mesh's attribute_sets and bdr_attribute_sets too.
   /// @a serial_elements are the numbers, in the mesh before distribution, of
   /// the elements of this rank; none stands for the order of the ranks.
   NamedMesh(std::unique_ptr<mfem::ParMesh> mesh, NameTable regions,
             NameTable boundaries, std::vector<int> serial_elements = {});

   mfem::ParMesh &Get() { return *mesh; }
   const mfem::ParMesh &Get() const { return *mesh; }
   MPI_Comm GetComm() const { return mesh->GetComm(); }

   /// Attributes of a region, ascending, at least one. Throws Error, which
   /// lists the names there are, if no region has this name, and if the region
   /// has no elements.
   mfem::Array<int> Region(const std::string &name) const;

   /// Attributes of a boundary, likewise.
   mfem::Array<int> Boundary(const std::string &name) const;

   const NameTable &Regions() const { return regions; }
   const NameTable &Boundaries() const { return boundaries; }

   /// Throws Error, which lists the names there are, if no vectors of elements
   /// have this name.
   const ElementVectors &Vectors(const std::string &name) const;

   /// The vectors by name; the names must be the same on all ranks.
   void SetVectors(std::map<std::string, ElementVectors> vectors_);

   /// For each element of this rank its number in the mesh before it was
   /// distributed: the same element whatever the number of ranks, and with the
   /// same order of its vertices.
   const std::vector<int> &SerialElements() const { return serial_elements; }

   const FileNumbers &Numbers() const { return numbers; }
   void SetNumbers(FileNumbers numbers_) { numbers = std::move(numbers_); }

private:
   std::unique_ptr<mfem::ParMesh> mesh;
   NameTable regions;
   NameTable boundaries;
   std::vector<int> serial_elements;
   std::map<std::string, ElementVectors> vectors;
   FileNumbers numbers;
};

/// The names that stand for an attribute, joined by slashes, or its number.
std::string NameOf(const NameTable &names, int attribute);

/// Distributes a serial mesh, the same on all ranks, by METIS, or by
/// @a partitioning (a rank for each element) when it is given. Collective.
/// Throws Error if the mesh is not three-dimensional, if a name stands for an
/// attribute that no element has, if there are more ranks than elements, and
/// on tangled elements, with their number, the first one's place in the serial
/// mesh (from 0), its region and its center.
NamedMesh DistributeMesh(mfem::Mesh &serial, NameTable regions,
                         NameTable boundaries, MPI_Comm comm,
                         const int *partitioning = nullptr);

/// Names of the boundaries on both sides of a contact.
struct FacingSurfaces
{
   std::vector<std::string> source;
   std::vector<std::string> destination;
};

/// What ReadGmsh() does to the mesh on its way in.
struct ReadOptions
{
   /// Factor on all coordinates, such as 1000 for meters to millimeters.
   mfem::real_t scale = 1.0;
   /// How often every element is split uniformly before distribution.
   int refine = 0;
   /// Where bodies will touch: ranks share the contact as evenly as the
   /// elements.
   std::vector<FacingSurfaces> contacts;
   /// What is added to the mesh, after it has been scaled; it is split as well.
   std::vector<RigidShape> shapes;
};

/// Reads a gmsh mesh (MSH 2.2 and 4.1, ascii and binary; tetrahedra, hexahedra,
/// prisms and pyramids, first order or curved) and distributes it. Collective:
/// rank 0 reads.
///
/// Physical groups give the names; their tags are the attributes. Elements in
/// several groups get an attribute of their own that is listed under each of
/// the names, and the outer faces in no group get one without a name. Physical
/// surfaces count only where they bound the volume: faces between two volume
/// elements are left out, and using a name that has none but those is an error.
/// Nodes of no volume element are left out. Elements numbered left-handed are
/// renumbered. Vectors of elements ($ElementData with three components) go by
/// the name of their view; the parts of a refined element have its vector.
///
/// Throws Error on a missing or damaged file, a mesh without volume elements,
/// volume elements in no physical group, surfaces that belong to no volume,
/// element types that MFEM does not have, tangled elements (with gmsh's number
/// of the first), and more ranks than elements.
NamedMesh ReadGmsh(const std::string &file, MPI_Comm comm,
                   const ReadOptions &options = ReadOptions());

} // namespace synovia
