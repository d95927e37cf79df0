#include "synovia/feb/feb_model.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

LoadCurve FebModel::Value(const FebInput &value) const
{
   const real_t factor = value.Number();
   const FebCurve *curve = FindCurve(value, curves);
   return curve ? curve->ForSteps(steps.ends, factor) : LoadCurve(factor);
}

LoadCurve FebModel::Value(const FebInput &from, const std::string &child) const
{
   const std::optional<FebInput> value = from.Find(child);
   if (!value)
   {
      from.Stop("<" + child + "> is missing");
      return LoadCurve(0.0);
   }
   return Value(*value);
}

RigidBodyCase *FebModel::FindRigid(const std::string &word,
                                   const FebInput &where)
{
   for (size_t i = 0; i < materials.rigid.size(); i++)
   {
      if (!word.empty() && materials.rigid[i].IsCalled(word))
      {
         return &setup.rigid_bodies[i];
      }
   }
   where.Stop("there is no rigid body called \"" + word + "\"");
   return nullptr;
}

bool FebModel::AreRigid(const std::vector<int> &nodes) const
{
   std::set<int> rigid;
   for (const int part : touching)
   {
      for (const FebCell &cell : mesh.parts[part].cells)
      {
         rigid.insert(cell.nodes.begin(), cell.nodes.end());
      }
   }
   return !nodes.empty() &&
          std::all_of(nodes.begin(), nodes.end(),
                      [&rigid](int node) { return rigid.count(node) > 0; });
}

} // namespace synovia
