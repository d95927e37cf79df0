#include "synovia/fem/tie_map.hpp"

namespace synovia
{

using namespace mfem;

TieMap::TieMap(const TieTangent &ties_, const HypreParMatrix &like)
   : ties(ties_), size(like.GetGlobalNumRows()), offsets{{like.RowPart()[0],
                                                          like.RowPart()[1]}}
{
   const RigidTies &tied = ties.Ties();
   for (const RigidTies::Slot &slot : tied.Slots())
   {
      places.push_back(slot.dof >= 0 ? offsets[0] + slot.dof : -1);
   }
   MPI_Allreduce(MPI_IN_PLACE, places.data(), static_cast<int>(places.size()),
                 HYPRE_MPI_BIG_INT, MPI_MAX, tied.GetComm());

   std::vector<Triplet> triplets;
   for (int dof = 0; dof < like.Height(); dof++)
   {
      if (tied.Dofs().FindSorted(dof) < 0)
      {
         triplets.push_back({offsets[0] + dof, offsets[0] + dof, 1.0});
      }
   }
   for (std::size_t k = 0; k < places.size(); k++)
   {
      const RigidTies::Slot &slot = tied.Slots()[k];
      if (!tied.IsFreedom(slot))
      {
         continue;
      }
      for (const TiedNodes::Node &node : tied.Nodes(slot.body).Get())
      {
         const Point3 motion = ties.Motion(slot, node.arm);
         for (int d = 0; d < 3; d++)
         {
            triplets.push_back(
               {offsets[0] + node.dof + d, places[k], motion[d]});
         }
      }
   }
   map = Square(triplets);
}

std::unique_ptr<HypreParMatrix>
TieMap::Square(const std::vector<Triplet> &triplets) const
{
   HYPRE_BigInt part[2] = {offsets[0], offsets[1]};
   return AssembleTriplets(ties.Ties().GetComm(), triplets, part, size, part,
                           size);
}

std::unique_ptr<HypreParMatrix> TieMap::Columns(const HypreParMatrix &a) const
{
   return std::unique_ptr<HypreParMatrix>(ParMult(&a, map.get(), true));
}

std::unique_ptr<HypreParMatrix> TieMap::Rows(const HypreParMatrix &a) const
{
   const std::unique_ptr<HypreParMatrix> transpose(map->Transpose());
   return std::unique_ptr<HypreParMatrix>(ParMult(transpose.get(), &a, true));
}

std::unique_ptr<HypreParMatrix> TieMap::Stiffness(const HypreParMatrix &k,
                                                  real_t support) const
{
   const RigidTies &tied = ties.Ties();
   const std::unique_ptr<HypreParMatrix> of_nodes(RAP(&k, map.get()));
   Vector diagonal(of_nodes->Height());
   of_nodes->GetDiag(diagonal);
   const Vector on_slots = tied.Gather(diagonal);

   std::vector<Triplet> triplets;
   std::vector<bool> is_slot(of_nodes->Height(), false);
   for (int i = 0; i < on_slots.Size(); i++)
   {
      const int dof = tied.Slots()[i].dof;
      if (dof < 0)
      {
         continue;
      }
      is_slot[dof] = true;
      triplets.push_back({places[i], places[i], support * on_slots[i]});
      for (int j = 0; j < on_slots.Size(); j++)
      {
         triplets.push_back({places[i], places[j], ties.Stiffness()(i, j)});
      }
   }
   for (const int dof : tied.Dofs())
   {
      if (!is_slot[dof])
      {
         triplets.push_back({offsets[0] + dof, offsets[0] + dof, 1.0});
      }
   }
   const std::unique_ptr<HypreParMatrix> beside = Square(triplets);
   return std::unique_ptr<HypreParMatrix>(Add(1.0, *of_nodes, 1.0, *beside));
}

} // namespace synovia
