#include "synovia/mesh/stack_bodies.hpp"
#include "synovia/general/error.hpp"
#include "synovia/mesh/element_nodes.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{

void Check(const std::vector<const Mesh *> &bodies)
{
   if (bodies.empty())
   {
      throw Error("there are no bodies to stack");
   }
   for (size_t i = 0; i < bodies.size(); i++)
   {
      const Mesh &body = *bodies[i];
      const std::string name = "body " + std::to_string(i);
      if (body.Dimension() != 3 || body.SpaceDimension() != 3)
      {
         throw Error(name + " is not three-dimensional");
      }
      if (body.Nonconforming() || body.NURBSext)
      {
         throw Error(name + " has hanging nodes or is a NURBS mesh, and cannot "
                            "be stacked");
      }
   }
}

int NodalOrder(const Mesh &mesh)
{
   return mesh.GetNodes() ? mesh.GetNodes()->FESpace()->GetMaxElementOrder()
                          : 0;
}

bool HasDiscontinuousNodes(const Mesh &mesh)
{
   return mesh.GetNodes() && mesh.GetNodes()->FESpace()->IsDGSpace();
}

void AddBody(const Mesh &body, int region_offset, int boundary_offset,
             Mesh &mesh)
{
   const int first = mesh.GetNV();
   for (int i = 0; i < body.GetNV(); i++)
   {
      mesh.AddVertex(body.GetVertex(i));
   }
   // A duplicate keeps the edge that refinement of a tetrahedron splits.
   const auto duplicate = [&](const Element &element, int offset)
   {
      Element *const copy = element.Duplicate(&mesh);
      int *const vertices = copy->GetVertices();
      std::for_each(vertices, vertices + copy->GetNVertices(),
                    [&](int &vertex) { vertex += first; });
      copy->SetAttribute(element.GetAttribute() + offset);
      return copy;
   };
   for (int i = 0; i < body.GetNE(); i++)
   {
      mesh.AddElement(duplicate(*body.GetElement(i), region_offset));
   }
   for (int i = 0; i < body.GetNBE(); i++)
   {
      mesh.AddBdrElement(duplicate(*body.GetBdrElement(i), boundary_offset));
   }
}

void CopyNodes(const std::vector<const Mesh *> &bodies, int order,
               bool discontinuous, Mesh &mesh)
{
   std::vector<int> first(1, 0);
   for (const Mesh *body : bodies)
   {
      first.push_back(first.back() + body->GetNE());
   }
   IsoparametricTransformation map;
   const auto positions_of = [&](int element, DenseMatrix &positions)
   {
      const auto next = std::upper_bound(first.begin(), first.end(), element);
      const size_t place = next - first.begin() - 1;
      bodies[place]->GetElementTransformation(element - first[place], &map);
      const FiniteElementSpace &space = *mesh.GetNodes()->FESpace();
      DenseMatrix columns;
      map.Transform(space.GetFE(element)->GetNodes(), columns);
      positions.Transpose(columns);
   };
   const int misfit = SetElementNodes(mesh, order, positions_of, discontinuous);
   MFEM_VERIFY(misfit < 0, "element " << misfit << " does not fit its body");
}

} // namespace

StackedBodies StackBodies(const std::vector<const Mesh *> &bodies)
{
   Check(bodies);
   int vertices = 0;
   int elements = 0;
   int faces = 0;
   int order = 0;
   bool discontinuous = false;
   for (const Mesh *body : bodies)
   {
      vertices += body->GetNV();
      elements += body->GetNE();
      faces += body->GetNBE();
      order = std::max(order, NodalOrder(*body));
      discontinuous = discontinuous || HasDiscontinuousNodes(*body);
   }

   StackedBodies stack{Mesh(3, vertices, elements, faces, 3), {}, {}};
   int regions = 0;
   int boundaries = 0;
   for (const Mesh *body : bodies)
   {
      stack.region_offsets.push_back(regions);
      stack.boundary_offsets.push_back(boundaries);
      AddBody(*body, regions, boundaries, stack.mesh);
      regions += body->attributes.Max();
      boundaries +=
         body->bdr_attributes.IsEmpty() ? 0 : body->bdr_attributes.Max();
   }
   stack.mesh.FinalizeTopology(false);
   if (order > 0)
   {
      CopyNodes(bodies, order, discontinuous, stack.mesh);
   }
   stack.mesh.Finalize(false, false);
   return stack;
}

} // namespace synovia
