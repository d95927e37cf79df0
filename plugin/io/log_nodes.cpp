#include "synovia/fem/node_positions.hpp"
#include "synovia/io/log_rows.hpp"
#include "synovia/mesh/boundary_marker.hpp"

#include <algorithm>
#include <set>

namespace synovia
{

using namespace mfem;

namespace
{
/// The places of vertices of this rank that a log asks for, ascending.
std::vector<int> FindVertices(const LogDefinition &log, NamedMesh &named)
{
   ParMesh &mesh = named.Get();
   const std::vector<long long> &numbers = named.Numbers().vertices;
   std::vector<bool> asked(mesh.GetNV(), true);
   const auto keep_those = [&](const std::vector<bool> &kept)
   {
      for (size_t v = 0; v < asked.size(); v++)
      {
         asked[v] = asked[v] && kept[v];
      }
   };
   Array<int> vertices;
   if (!log.numbers.empty())
   {
      const std::set<long long> wanted(log.numbers.begin(), log.numbers.end());
      std::vector<bool> kept(mesh.GetNV());
      for (int v = 0; v < mesh.GetNV(); v++)
      {
         kept[v] = wanted.count(numbers[v]) > 0;
      }
      keep_those(kept);
   }
   if (!log.regions.empty())
   {
      std::vector<bool> kept(mesh.GetNV());
      for (const std::string &name : log.regions)
      {
         const Array<int> attributes = named.Region(name);
         for (int e = 0; e < mesh.GetNE(); e++)
         {
            if (attributes.Find(mesh.GetAttribute(e)) >= 0)
            {
               mesh.GetElementVertices(e, vertices);
               for (const int v : vertices)
               {
                  kept[v] = true;
               }
            }
         }
      }
      keep_those(kept);
   }
   if (!log.surfaces.empty())
   {
      std::vector<bool> kept(mesh.GetNV());
      for (const std::string &name : log.surfaces)
      {
         const Array<int> attributes = named.Boundary(name);
         for (int b = 0; b < mesh.GetNBE(); b++)
         {
            if (attributes.Find(mesh.GetBdrAttribute(b)) >= 0)
            {
               mesh.GetBdrElementVertices(b, vertices);
               for (const int v : vertices)
               {
                  kept[v] = true;
               }
            }
         }
      }
      keep_those(kept);
   }
   std::vector<int> found;
   for (int v = 0; v < mesh.GetNV(); v++)
   {
      if (asked[v])
      {
         found.push_back(v);
      }
   }
   return found;
}

class NodeRows : public LogRows
{
public:
   NodeRows(const LogDefinition &log_, BiphasicProblem &problem_)
      : log(log_), problem(problem_)
   {
      NamedMesh &mesh = problem.Mesh();
      VerifyLogged(log, mesh.Numbers().vertices, mesh.GetComm());
      vertices = FindVertices(log, mesh);
      ParFiniteElementSpace &space = problem.Spaces().Displacement();
      ParGridFunction at_nodes(&space);
      at_nodes.SetFromTrueDofs(NodePositions(space));
      at_nodes.HostRead();
      positions = at_nodes;
   }

   std::vector<real_t> Collect(TimeStepper &stepper) override
   {
      ParFiniteElementSpace &space = problem.Spaces().Displacement();
      ParGridFunction forces(&space);
      forces.SetFromTrueDofs(ForcesOfBodies());
      forces.HostRead();
      const ParGridFunction &u = stepper.Displacement();
      const ParGridFunction &p = stepper.Pressure();
      u.HostRead();
      p.HostRead();
      std::vector<real_t> rows;
      Array<int> dofs;
      std::vector<real_t> values;
      for (const int v : vertices)
      {
         space.GetVertexVDofs(v, dofs);
         values.clear();
         for (int d = 0; d < 3; d++)
         {
            values.push_back(positions[dofs[d]] + u[dofs[d]]);
         }
         for (const Vector *field : {static_cast<const Vector *>(&u),
                                     static_cast<const Vector *>(&forces)})
         {
            for (int d = 0; d < 3; d++)
            {
               values.push_back((*field)[dofs[d]]);
            }
         }
         problem.Spaces().Pressure().GetVertexDofs(v, dofs);
         values.push_back(p[dofs[0]]);
         rows.push_back(
            static_cast<real_t>(problem.Mesh().Numbers().vertices[v]));
         AddLogged(log, values, rows);
      }
      return rows;
   }

private:
   // The reverse of what acts on the bodies' nodes: of the support where there
   // is one, else of loads and contact; true dofs.
   Vector ForcesOfBodies()
   {
      const StageBalance &balance = problem.Operator().Balance();
      Vector forces(balance.support);
      forces += balance.loads;
      forces.Neg();
      forces.HostReadWrite();
      balance.support.HostRead();
      for (const int dof : problem.Conditions().DisplacementDofs())
      {
         forces[dof] = -balance.support[dof];
      }
      return forces;
   }

   const LogDefinition &log;
   BiphasicProblem &problem;
   std::vector<int> vertices;
   Vector positions;
};
} // namespace

std::unique_ptr<LogRows> MakeNodeRows(const LogDefinition &log,
                                      BiphasicProblem &problem)
{
   return std::make_unique<NodeRows>(log, problem);
}

} // namespace synovia
