#include "synovia/linalg/biphasic_jacobian.hpp"

namespace synovia
{

using namespace mfem;

std::unique_ptr<HypreParMatrix> WeightedSquare(const HypreParMatrix &factor,
                                               const Vector &weights)
{
   HypreParMatrix scaled(factor);
   scaled.ScaleRows(weights);
   const std::unique_ptr<HypreParMatrix> transpose(factor.Transpose());
   return std::unique_ptr<HypreParMatrix>(
      ParMult(transpose.get(), &scaled, true));
}

void AddWeightedSquare(const HypreParMatrix &factor, const Vector &weights,
                       std::unique_ptr<HypreParMatrix> &sum)
{
   auto square = WeightedSquare(factor, weights);
   if (sum)
   {
      square.reset(Add(1.0, *sum, 1.0, *square));
   }
   sum = std::move(square);
}

BiphasicJacobian::BiphasicJacobian(const VolumeMatrices &matrices_,
                                   const Array<int> &offsets_,
                                   const Array<int> &u_dofs_,
                                   const ContactPairs &pairs_,
                                   const RigidSurfaces *rigid_)
   : Operator(offsets_.Last()), original(matrices_),
     reduced(rigid_
                ? std::make_unique<VolumeMatrices>(rigid_->Reduce(matrices_))
                : nullptr),
     matrices(reduced ? *reduced : matrices_), offsets(offsets_),
     u_dofs(u_dofs_), pairs(pairs_), rigid(rigid_)
{
   if (rigid)
   {
      u_dofs.Append(rigid->Idle());
      u_dofs.Sort();
   }
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

void BiphasicJacobian::ContactMoved()
{
   reduced_gaps.clear();
   if (rigid)
   {
      for (const ContactPair *pair : pairs)
      {
         reduced_gaps.push_back(rigid->Reduce(*pair->Factors().gap));
      }
   }
}

void BiphasicJacobian::AddContact(const HypreParMatrix &factor,
                                  const Vector &weights, real_t scale,
                                  const Vector &x, Vector &y) const
{
   rows.SetSize(factor.Height());
   factor.Mult(x, rows);
   rows *= weights;
   product.SetSize(factor.Width());
   factor.MultTranspose(rows, product);
   y.Add(scale, product);
}

void BiphasicJacobian::MultDisplacement(const Vector &x, Vector &y) const
{
   u_free = x;
   u_free.SetSubVector(u_dofs, 0.0);
   matrices.stiffness->Mult(u_free, y);
   for (size_t i = 0; i < pairs.size(); i++)
   {
      AddContact(Gap(i), *pairs[i]->Factors().gap_weights, 1.0, u_free, y);
   }
   CopyEntries(u_dofs, x, y);
}

void BiphasicJacobian::AddDivergence(const Vector &x, Vector &y) const
{
   matrices.divergence->Mult(1.0, x, 1.0, y);
}

void BiphasicJacobian::Mult(const Vector &x, Vector &y) const
{
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
   flow->Mult(-1.0, p_free, 0.0, y_p);
   for (const ContactPair *pair : pairs)
   {
      AddContact(*pair->Factors().jump, *pair->Factors().jump_weights, -dt,
                 p_free, y_p);
   }
   // MultDisplacement leaves x_u with zeros at prescribed dofs in u_free.
   MultDisplacement(x_u, y_u);
   matrices.divergence->Mult(-1.0, u_free, 1.0, y_p);
   matrices.divergence_transpose->Mult(-1.0, p_free, 1.0, y_u);
   CopyEntries(u_dofs, x_u, y_u);
   CopyEntries(p_dofs, x_p, y_p);
   y_u.SyncAliasMemory(y);
   y_p.SyncAliasMemory(y);
}

std::unique_ptr<HypreParMatrix>
BiphasicJacobian::DisplacementBlock(const std::vector<Vector> &weights) const
{
   // What is small is added up first, and what is large copied once.
   std::unique_ptr<HypreParMatrix> contact;
   for (size_t i = 0; i < pairs.size(); i++)
   {
      AddWeightedSquare(Gap(i), weights[i], contact);
   }
   std::unique_ptr<HypreParMatrix> block(
      contact ? Add(1.0, *matrices.stiffness, 1.0, *contact)
              : new HypreParMatrix(*matrices.stiffness));
   block->EliminateBC(u_dofs, DIAG_ONE);
   return block;
}

std::unique_ptr<HypreParMatrix> BiphasicJacobian::PressureBlock() const
{
   std::unique_ptr<HypreParMatrix> block =
      std::make_unique<HypreParMatrix>(*flow);
   for (const ContactPair *pair : pairs)
   {
      const auto contact =
         WeightedSquare(*pair->Factors().jump, *pair->Factors().jump_weights);
      block.reset(Add(1.0, *block, dt, *contact));
   }
   return block;
}

std::unique_ptr<HypreParMatrix>
BiphasicJacobian::SchurComplement(const Array<int> &dofs) const
{
   // B K^-1 B^T is at most M / H_A, which it is where nothing can give way
   // sideways, and less the freer the body.
   constexpr real_t typical = 0.6;
   std::unique_ptr<HypreParMatrix> schur(
      Add(1.0, *flow, typical, *matrices.compliance));
   schur->EliminateBC(dofs, DIAG_ONE);
   return schur;
}

Vector BiphasicJacobian::Holding() const
{
   // Small enough to be taken back from a factorization, and large beside what
   // contact adds to the diagonal.
   constexpr real_t large = 1e11;
   const std::unique_ptr<HypreParMatrix> schur(
      Add(1.0, *flow, 1.0, *matrices.compliance));
   Vector holding(schur->Height());
   schur->GetDiag(holding);
   holding *= large;
   return holding;
}

std::unique_ptr<HypreParMatrix>
BiphasicJacobian::AssembleHeld(const Vector &holding) const
{
   std::vector<Vector> gap_weights;
   for (const ContactPair *pair : pairs)
   {
      gap_weights.push_back(*pair->Factors().gap_weights);
   }
   const std::unique_ptr<HypreParMatrix> stiffness =
      DisplacementBlock(gap_weights);

   HypreParMatrix divergence(*matrices.divergence);
   delete divergence.EliminateCols(u_dofs);
   const std::unique_ptr<HypreParMatrix> transpose(divergence.Transpose());
   const std::unique_ptr<HypreParMatrix> pressure = PressureBlock();
   SparseMatrix diagonal;
   pressure->GetDiag(diagonal);
   for (const int dof : OnHost(p_dofs))
   {
      diagonal.Add(dof, dof, holding[dof]);
   }
   Array2D<const HypreParMatrix *> blocks(2, 2);
   blocks(0, 0) = stiffness.get();
   blocks(0, 1) = transpose.get();
   blocks(1, 0) = &divergence;
   blocks(1, 1) = pressure.get();
   Array2D<real_t> signs(2, 2);
   signs = -1.0;
   signs(0, 0) = 1.0;
   return std::unique_ptr<HypreParMatrix>(
      HypreParMatrixFromBlocks(blocks, &signs));
}

} // namespace synovia
