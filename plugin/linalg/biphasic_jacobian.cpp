#include "synovia/linalg/biphasic_jacobian.hpp"
#include "synovia/general/profiled_work.hpp"
#include "synovia/linalg/bytes_read.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

std::unique_ptr<HypreParMatrix> WeightedProduct(const HypreParMatrix &left,
                                                const Vector &weights,
                                                const HypreParMatrix &right)
{
   HypreParMatrix scaled(right);
   scaled.ScaleRows(weights);
   const std::unique_ptr<HypreParMatrix> transpose(left.Transpose());
   return std::unique_ptr<HypreParMatrix>(
      ParMult(transpose.get(), &scaled, true));
}

void AddTo(std::unique_ptr<HypreParMatrix> &sum,
           std::unique_ptr<HypreParMatrix> term)
{
   sum = sum ? std::unique_ptr<HypreParMatrix>(Add(1.0, *sum, 1.0, *term))
             : std::move(term);
}

BiphasicJacobian::BiphasicJacobian(const VolumeMatrices &matrices_,
                                   const Array<int> &offsets_,
                                   const Array<int> &u_dofs_,
                                   const ContactTerms &contact_,
                                   const RigidSurfaces *rigid_,
                                   const TieTangent *ties_)
   : Operator(offsets_.Last()), original(matrices_),
     reduced(rigid_
                ? std::make_unique<VolumeMatrices>(rigid_->Reduce(matrices_))
                : nullptr),
     matrices(reduced ? *reduced : matrices_), offsets(offsets_),
     u_dofs(u_dofs_), rigid(rigid_), ties(ties_), contact(contact_, rigid_)
{
   if (rigid)
   {
      u_dofs.Append(rigid->Idle());
   }
   u_dofs.Sort();
   u_dofs.Unique();
   if (!ties)
   {
      prescribed_dofs = u_dofs;
      return;
   }
   for (const int dof : u_dofs)
   {
      if (ties->Ties().Dofs().FindSorted(dof) < 0)
      {
         prescribed_dofs.Append(dof);
      }
   }
   u_dofs.Append(ties->Ties().Dofs());
   u_dofs.Sort();
   u_dofs.Unique();
}

void BiphasicJacobian::SetTimeStep(real_t dt_)
{
   if (flow && dt_ == dt)
   {
      return;
   }
   dt = dt_;
   flow = std::make_unique<HypreParMatrix>(*matrices.darcy);
   *flow *= dt;
   if (matrices.stabilization)
   {
      flow.reset(Add(1.0, *flow, 1.0, *matrices.stabilization));
   }
}

void BiphasicJacobian::BodiesChanged()
{
   if (rigid)
   {
      *reduced = rigid->Reduce(original);
   }
   flow.reset();
   SetTimeStep(dt);
}

void BiphasicJacobian::ContactChanged()
{
   contact.Update();
}

bool BiphasicJacobian::IsContactSymmetric() const
{
   return std::all_of(Contact().begin(), Contact().end(),
                      [](const ContactFactors &pair)
                      { return pair.IsSymmetric() && pair.IsUncoupled(); });
}

void BiphasicJacobian::AddContactForces(const Vector &u, const Vector &p,
                                        Vector &y) const
{
   for (const ContactFactors &pair : Contact())
   {
      rows.SetSize(pair.gap_change->Height());
      pair.gap_change->Mult(u, rows);
      rows *= *pair.gap_weights;
      product.SetSize(y.Size());
      pair.gap->MultTranspose(rows, product);
      y += product;
      if (pair.force_change)
      {
         pair.force_change->Mult(1.0, u, 1.0, y);
      }
      if (pair.force_by_pressure)
      {
         pair.force_by_pressure->Mult(1.0, p, 1.0, y);
      }
   }
}

void BiphasicJacobian::AddContactMass(real_t scale, const Vector *u,
                                      const Vector *p, Vector &y) const
{
   for (const ContactFactors &pair : Contact())
   {
      const bool jump_changes = u && pair.jump_change;
      if (p || jump_changes)
      {
         rows.SetSize(pair.jump->Height());
         rows = 0.0;
         if (p)
         {
            pair.jump->Mult(*p, rows);
         }
         if (jump_changes)
         {
            pair.jump_change->Mult(1.0, *u, 1.0, rows);
         }
         rows *= *pair.jump_weights;
         product.SetSize(y.Size());
         pair.jump->MultTranspose(rows, product);
         y.Add(scale, product);
      }
      if (u && pair.outflow_change)
      {
         pair.outflow_change->Mult(scale, *u, 1.0, y);
      }
   }
}

void BiphasicJacobian::AddMassOfDisplacement(const Vector &x, Vector &y) const
{
   matrices.divergence->Mult(1.0, x, 1.0, y);
   AddContactMass(dt, &x, nullptr, y);
}

double BiphasicJacobian::BytesOfBodies() const
{
   return BytesOf(matrices.stiffness.get()) +
          BytesOf(matrices.divergence.get()) +
          BytesOf(matrices.divergence_transpose.get()) + BytesOf(flow.get());
}

void BiphasicJacobian::Mult(const Vector &x, Vector &y) const
{
   const ProfiledWork work("jacobian", BytesOfBodies());
   x.Read();
   const Vector x_u(const_cast<Vector &>(x), offsets[0],
                    offsets[1] - offsets[0]);
   const Vector x_p(const_cast<Vector &>(x), offsets[1],
                    offsets[2] - offsets[1]);
   y.Write();
   Vector y_u(y, offsets[0], x_u.Size());
   Vector y_p(y, offsets[1], x_p.Size());

   p_free = x_p;
   p_free.SetSubVector(p_dofs, 0.0);
   u_free = x_u;
   u_free.SetSubVector(u_dofs, 0.0);
   Vector amounts;
   if (ties)
   {
      amounts = ties->Ties().Gather(x_u);
      ties->Move(amounts, u_free);
   }
   flow->Mult(-1.0, p_free, 0.0, y_p);
   AddContactMass(-dt, &u_free, &p_free, y_p);
   matrices.stiffness->Mult(u_free, y_u);
   AddContactForces(u_free, p_free, y_u);
   matrices.divergence->Mult(-1.0, u_free, 1.0, y_p);
   matrices.divergence_transpose->Mult(-1.0, p_free, 1.0, y_u);
   Vector on_freedoms;
   if (ties)
   {
      on_freedoms = ties->Collect(y_u);
      ties->Stiffness().AddMult(amounts, on_freedoms);
   }
   CopyEntries(u_dofs, x_u, y_u);
   CopyEntries(p_dofs, x_p, y_p);
   if (ties)
   {
      ties->Ties().Scatter(on_freedoms, y_u);
   }
   y_u.SyncAliasMemory(y);
   y_p.SyncAliasMemory(y);
}

std::vector<const HypreParMatrix *>
BiphasicJacobian::StiffnessUnderTraction() const
{
   std::vector<const HypreParMatrix *> terms{matrices.stiffness.get()};
   for (const ContactFactors &pair : Contact())
   {
      if (pair.force_change)
      {
         terms.push_back(pair.force_change);
      }
   }
   return terms;
}

std::unique_ptr<HypreParMatrix>
BiphasicJacobian::DisplacementBlock(const std::vector<Vector> &weights) const
{
   std::unique_ptr<HypreParMatrix> sum;
   for (size_t i = 0; i < Contact().size(); i++)
   {
      const ContactFactors &pair = Contact()[i];
      const HypreParMatrix *const force_change =
         pair.soft_force_change ? pair.soft_force_change : pair.force_change;
      if (force_change)
      {
         AddTo(sum, std::make_unique<HypreParMatrix>(*force_change));
      }
      const HypreParMatrix &gap = *pair.gap;
      AddTo(sum, WeightedProduct(gap, weights[i], gap));
   }
   std::unique_ptr<HypreParMatrix> block = AddToBodies(std::move(sum));
   Eliminate(u_dofs, *block);
   return block;
}

std::unique_ptr<HypreParMatrix>
BiphasicJacobian::MomentumBlock(const TieMap *map, real_t support) const
{
   std::unique_ptr<HypreParMatrix> sum = ForceChange();
   for (const ContactFactors &pair : Contact())
   {
      AddTo(sum,
            WeightedProduct(*pair.gap, *pair.gap_weights, *pair.gap_change));
   }
   std::unique_ptr<HypreParMatrix> block = AddToBodies(std::move(sum));
   if (map)
   {
      block = map->Stiffness(*block, support);
   }
   Eliminate(prescribed_dofs, *block);
   return block;
}

std::unique_ptr<HypreParMatrix> BiphasicJacobian::ForceChange() const
{
   std::unique_ptr<HypreParMatrix> sum;
   for (const ContactFactors &pair : Contact())
   {
      if (pair.force_change)
      {
         AddTo(sum, std::make_unique<HypreParMatrix>(*pair.force_change));
      }
   }
   return sum;
}

std::unique_ptr<HypreParMatrix> BiphasicJacobian::AddToBodies(
   std::unique_ptr<HypreParMatrix> contact_terms) const
{
   // Small matrices are added up first, so that the large one is copied once.
   return std::unique_ptr<HypreParMatrix>(
      contact_terms ? Add(1.0, *matrices.stiffness, 1.0, *contact_terms)
                    : new HypreParMatrix(*matrices.stiffness));
}

void BiphasicJacobian::Eliminate(const Array<int> &dofs,
                                 HypreParMatrix &block) const
{
   if (IsContactSymmetric())
   {
      block.EliminateBC(dofs, DIAG_ONE);
   }
   else
   {
      // The former looks for columns only where rows have entries.
      delete block.EliminateRowsCols(dofs);
   }
}

std::unique_ptr<HypreParMatrix>
BiphasicJacobian::LoadBlock(const TieMap *map) const
{
   auto block =
      std::make_unique<HypreParMatrix>(*matrices.divergence_transpose);
   for (const ContactFactors &pair : Contact())
   {
      if (pair.force_by_pressure)
      {
         block.reset(Add(1.0, *block, -1.0, *pair.force_by_pressure));
      }
   }
   if (map)
   {
      block = map->Rows(*block);
   }
   Vector counts(block->Height());
   counts = 1.0;
   counts.SetSubVector(prescribed_dofs, 0.0);
   block->ScaleRows(counts);
   return block;
}

std::unique_ptr<HypreParMatrix>
BiphasicJacobian::CouplingBlock(const TieMap *map) const
{
   std::unique_ptr<HypreParMatrix> sum;
   for (const ContactFactors &pair : Contact())
   {
      if (pair.jump_change)
      {
         AddTo(sum, WeightedProduct(*pair.jump, *pair.jump_weights,
                                    *pair.jump_change));
      }
      if (pair.outflow_change)
      {
         AddTo(sum, std::make_unique<HypreParMatrix>(*pair.outflow_change));
      }
   }
   std::unique_ptr<HypreParMatrix> block(
      sum ? Add(1.0, *matrices.divergence, dt, *sum)
          : new HypreParMatrix(*matrices.divergence));
   if (map)
   {
      block = map->Columns(*block);
   }
   delete block->EliminateCols(prescribed_dofs);
   return block;
}

std::unique_ptr<HypreParMatrix> BiphasicJacobian::PressureBlock() const
{
   std::unique_ptr<HypreParMatrix> block =
      std::make_unique<HypreParMatrix>(*flow);
   for (const ContactFactors &pair : Contact())
   {
      const auto jumps =
         WeightedProduct(*pair.jump, *pair.jump_weights, *pair.jump);
      block.reset(Add(1.0, *block, dt, *jumps));
   }
   return block;
}

std::unique_ptr<HypreParMatrix>
BiphasicJacobian::SchurComplement(const Array<int> &dofs,
                                  real_t compliance) const
{
   std::unique_ptr<HypreParMatrix> schur(
      Add(1.0, *flow, compliance, *matrices.compliance));
   schur->EliminateBC(dofs, DIAG_ONE);
   return schur;
}

Vector BiphasicJacobian::Holding(real_t large) const
{
   const std::unique_ptr<HypreParMatrix> schur(
      Add(1.0, *flow, 1.0, *matrices.compliance));
   Vector holding(schur->Height());
   schur->GetDiag(holding);
   holding.HostReadWrite();
   // Pressures that no fluid has are in no equation.
   real_t scale = holding.Size() > 0 ? holding.Normlinf() : 0.0;
   scale = scale > 0.0 ? scale : 1.0;
   for (real_t &entry : holding)
   {
      entry = large * (entry != 0.0 ? entry : scale);
   }
   return holding;
}

std::unique_ptr<TieMap> BiphasicJacobian::MakeTieMap() const
{
   return ties ? std::make_unique<TieMap>(*ties, *matrices.stiffness) : nullptr;
}

std::unique_ptr<HypreParMatrix>
BiphasicJacobian::AssembleHeld(const Vector &holding, real_t support) const
{
   const std::unique_ptr<TieMap> map = MakeTieMap();
   const std::unique_ptr<HypreParMatrix> momentum =
      MomentumBlock(map.get(), support);
   const std::unique_ptr<HypreParMatrix> coupling = CouplingBlock(map.get());
   std::unique_ptr<HypreParMatrix> transpose;
   if (IsContactSymmetric())
   {
      transpose.reset(coupling->Transpose());
   }
   else
   {
      transpose = LoadBlock(map.get());
   }
   const std::unique_ptr<HypreParMatrix> pressure = PressureBlock();
   SparseMatrix diagonal;
   pressure->GetDiag(diagonal);
   for (const int dof : OnHost(p_dofs))
   {
      diagonal.Add(dof, dof, holding[dof]);
   }
   Array2D<const HypreParMatrix *> blocks(2, 2);
   blocks(0, 0) = momentum.get();
   blocks(0, 1) = transpose.get();
   blocks(1, 0) = coupling.get();
   blocks(1, 1) = pressure.get();
   Array2D<real_t> signs(2, 2);
   signs = -1.0;
   signs(0, 0) = 1.0;
   return std::unique_ptr<HypreParMatrix>(
      HypreParMatrixFromBlocks(blocks, &signs));
}

} // namespace synovia
