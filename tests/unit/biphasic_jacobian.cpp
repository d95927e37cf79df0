// ranks: 1 2 3 4
// timeout: 300
//
// The Jacobian of two bodies that are partly in contact, partly apart, partly
// sealed and partly drained: as it is applied, as it is assembled, and as it is
// solved.

#include "support/touching_blocks.hpp"
#include "synovia/linalg/biphasic_linear_solver.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t dt = 3.0;

class Bodies : public TouchingBlocks
{
public:
   explicit Bodies(int order) : TouchingBlocks(Options(order))
   {
      Vector u = Displacement(0.0);
      pair->Search(u);
      Touch(u, RandomEntries(spaces.Pressure().GetTrueVSize(), 3));
      contact.push_back(pair->Factors());
      matrices = std::make_unique<VolumeMatrices>(spaces, materials);
   }

   real_t Dot(const Vector &x, const Vector &y) const
   {
      return InnerProduct(mesh.GetComm(), x, y);
   }

   // Some true dofs at two surfaces, as if prescribed.
   Array<int> Prescribed(ParFiniteElementSpace &space) const
   {
      Array<int> marker(mesh.Get().bdr_attributes.Max());
      marker = 0;
      marker[mesh.Boundary("lower_z0")[0] - 1] = 1;
      marker[mesh.Boundary("upper_x0")[0] - 1] = 1;
      Array<int> dofs;
      space.GetEssentialTrueDofs(marker, dofs);
      return dofs;
   }

   Vector Random(int seed) const
   {
      return RandomEntries(spaces.Offsets().Last(), seed);
   }

   ContactTerms contact;
   std::unique_ptr<VolumeMatrices> matrices;

private:
   static TouchingBlocksOptions Options(int order)
   {
      TouchingBlocksOptions options;
      options.order = order;
      return options;
   }
};

/// Contact whose forces and jumps change with the displacement in every way, by
/// matrices that mean nothing.
class ComplexContact
{
public:
   explicit ComplexContact(const Bodies &bodies)
   {
      ContactFactors factors = bodies.contact[0];
      gap_weights = *factors.gap_weights;
      jump_weights = *factors.jump_weights;
      other_gap.reset(ParMult(factors.jump, bodies.matrices->divergence.get()));
      gap_change.reset(Add(1.0, *factors.gap, 1.0, *other_gap));
      Vector moderate(gap_weights);
      moderate *= 1e-2;
      force_change = WeightedProduct(*factors.gap, moderate, *other_gap);
      outflow_change = WeightedProduct(*factors.jump, moderate, *factors.gap);
      *outflow_change *= 0.1;
      factors.gap_change = gap_change.get();
      factors.force_change = force_change.get();
      factors.jump_change = other_gap.get();
      factors.outflow_change = outflow_change.get();
      factors.gap_weights = &gap_weights;
      factors.jump_weights = &jump_weights;
      terms.push_back(factors);
   }

   /// Every third vertex leaves.
   void LiftSome()
   {
      for (int j = 0; j < gap_weights.Size(); j += 3)
      {
         gap_weights[j] = 0.0;
         jump_weights[j] = 0.0;
      }
   }

   Vector gap_weights;
   Vector jump_weights;
   ContactTerms terms;

private:
   std::unique_ptr<HypreParMatrix> other_gap;
   std::unique_ptr<HypreParMatrix> gap_change;
   std::unique_ptr<HypreParMatrix> force_change;
   std::unique_ptr<HypreParMatrix> outflow_change;
};

Array<int> EverySecond(const Array<int> &dofs)
{
   Array<int> some;
   for (int i = 0; i < dofs.Size(); i += 2)
   {
      some.Append(dofs[i]);
   }
   return some;
}

void SetToZero(const Array<int> &dofs, int begin, Vector &x)
{
   for (const int dof : dofs)
   {
      x[begin + dof] = 0.0;
   }
}
} // namespace

TEST_CASE("The bodies are in contact and out of it, sealed and drained")
{
   const int order = GENERATE(1, 2);
   const Bodies bodies(order);
   const auto [active, sealed, present] = bodies.Counts();
   CAPTURE(order, active, sealed, present);
   CHECK(sealed > 2);
   CHECK(active > sealed + 2);
   CHECK(present > active + 2);
}

TEST_CASE("The Jacobian is symmetric, and the assembled one is the same")
{
   const int order = GENERATE(1, 2);
   CAPTURE(order);
   const Bodies bodies(order);
   const Array<int> &offsets = bodies.spaces.Offsets();
   const Array<int> u_dofs = bodies.Prescribed(bodies.spaces.Displacement());
   const Array<int> p_dofs = bodies.Prescribed(bodies.spaces.Pressure());
   BiphasicJacobian jacobian(*bodies.matrices, offsets, u_dofs, bodies.contact);
   jacobian.SetTimeStep(dt);
   jacobian.SetPressureDofs(p_dofs);
   const Vector holding = jacobian.Holding(1e11);
   const auto assembled = jacobian.AssembleHeld(holding, 0.0);
   Vector ax(offsets.Last());
   Vector ay(ax.Size());
   Vector bx(ax.Size());
   for (int seed = 1; seed <= 5; seed++)
   {
      const Vector x = bodies.Random(seed);
      const Vector y = bodies.Random(seed + 100);
      jacobian.Mult(x, ax);
      jacobian.Mult(y, ay);
      const real_t size = std::sqrt(bodies.Dot(ax, ax) * bodies.Dot(y, y));
      CHECK(std::abs(bodies.Dot(y, ax) - bodies.Dot(x, ay)) <= 1e-12 * size);

      // Definite: positive in the displacement, negative in the pressure.
      Vector x_u(x);
      Vector x_p(x);
      for (int i = 0; i < x.Size(); i++)
      {
         (i < offsets[1] ? x_p : x_u)[i] = 0.0;
      }
      for (const int dof : p_dofs)
      {
         x_p[offsets[1] + dof] = 0.0;
      }
      jacobian.Mult(x_u, ay);
      CHECK(bodies.Dot(x_u, ay) > 0.0);
      jacobian.Mult(x_p, ay);
      CHECK(bodies.Dot(x_p, ay) < 0.0);

      // Prescribed pressures have unit rows here, and are held there.
      Vector at_rest(x);
      for (const int dof : p_dofs)
      {
         at_rest[offsets[1] + dof] = 0.0;
      }
      jacobian.Mult(at_rest, ax);
      assembled->Mult(at_rest, bx);
      for (const int dof : p_dofs)
      {
         bx[offsets[1] + dof] = 0.0;
      }
      bx -= ax;
      CHECK(std::sqrt(bodies.Dot(bx, bx)) <=
            1e-12 * std::sqrt(bodies.Dot(ax, ax)));
   }
}

TEST_CASE("Contact with all its changes is applied as it is assembled")
{
   const int order = GENERATE(1, 2);
   CAPTURE(order);
   const Bodies bodies(order);
   const ComplexContact contact(bodies);
   const Array<int> &offsets = bodies.spaces.Offsets();
   const Array<int> u_dofs = bodies.Prescribed(bodies.spaces.Displacement());
   const Array<int> p_dofs = bodies.Prescribed(bodies.spaces.Pressure());
   BiphasicJacobian jacobian(*bodies.matrices, offsets, u_dofs, contact.terms);
   jacobian.SetTimeStep(dt);
   jacobian.SetPressureDofs(p_dofs);
   CHECK_FALSE(jacobian.IsContactSymmetric());
   const auto assembled = jacobian.AssembleHeld(jacobian.Holding(1e11), 0.0);
   Vector ax(offsets.Last());
   Vector ay(ax.Size());
   Vector bx(ax.Size());
   for (int seed = 1; seed <= 3; seed++)
   {
      Vector x = bodies.Random(seed);
      const Vector y = bodies.Random(seed + 100);
      jacobian.Mult(x, ax);
      jacobian.Mult(y, ay);
      CHECK(std::abs(bodies.Dot(y, ax) - bodies.Dot(x, ay)) >
            1e-6 * std::sqrt(bodies.Dot(ax, ax) * bodies.Dot(y, y)));

      SetToZero(p_dofs, offsets[1], x);
      jacobian.Mult(x, ax);
      assembled->Mult(x, bx);
      SetToZero(p_dofs, offsets[1], bx);
      bx -= ax;
      CHECK(std::sqrt(bodies.Dot(bx, bx)) <=
            1e-12 * std::sqrt(bodies.Dot(ax, ax)));
   }
}

/// Linear systems of two bodies in contact with all its changes.
class TouchingBodies
{
public:
   explicit TouchingBodies(LinearMethod method)
      : solver(jacobian, bodies.spaces, Options(method))
   {
      jacobian.SetTimeStep(dt);
      jacobian.SetPressureDofs(bodies.Prescribed(bodies.spaces.Pressure()));
      tolerance.momentum = tolerance.mass = 1e-9;
   }
   /// Whether @a x is @a factor times the exact solution.
   void CheckSolution(Vector x, real_t factor) const
   {
      x.Add(-factor, exact);
      CHECK(std::sqrt(bodies.Dot(x, x)) <=
            1e-5 * std::sqrt(bodies.Dot(exact, exact)));
   }

   const Bodies bodies{2};
   ComplexContact contact{bodies};
   BiphasicJacobian jacobian{*bodies.matrices, bodies.spaces.Offsets(),
                             bodies.Prescribed(bodies.spaces.Displacement()),
                             contact.terms};
   BiphasicLinearSolver solver;
   const Vector exact = bodies.Random(1);
   ResidualTolerance tolerance;

private:
   static LinearOptions Options(LinearMethod method)
   {
      LinearOptions options;
      options.method = method;
      return options;
   }
};

TEST_CASE("Contact with all its changes is solved by either method")
{
   const LinearMethod method =
      GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   TouchingBodies touching(method);
   BiphasicJacobian &jacobian = touching.jacobian;
   BiphasicLinearSolver &solver = touching.solver;
   const bool direct = method == LinearMethod::direct;
   CAPTURE(direct);
   Vector right_side(jacobian.Height());
   Vector found(jacobian.Height());
   for (const int change : {0, 1, 2})
   {
      CAPTURE(change);
      if (change == 1)
      {
         touching.contact.LiftSome();
      }
      if (change == 2)
      {
         jacobian.SetPressureDofs(EverySecond(jacobian.PressureDofs()));
      }
      jacobian.Mult(touching.exact, right_side);
      const BiphasicLinearSolver::Result result =
         solver.Solve(right_side, found, touching.tolerance, 1.0);
      CAPTURE(result.failure, result.iterations);
      CHECK(result.converged);
      // What is kept of the factorization is exact, and what pressures are
      // let go is to some digits.
      const int most = change == 2 ? 6 : 2;
      CHECK(result.iterations <= (direct ? most : 60));
      touching.CheckSolution(found, 1.0);
   }
   if (direct)
   {
      CHECK(solver.Work().factorizations == 1);
      CHECK(solver.Work().columns > 0);
   }
}

TEST_CASE("A guess that serves needs no preconditioner")
{
   const LinearMethod method =
      GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   TouchingBodies touching(method);
   BiphasicJacobian &jacobian = touching.jacobian;
   BiphasicLinearSolver &solver = touching.solver;
   CAPTURE(static_cast<int>(method));
   const Bodies &bodies = touching.bodies;
   const ResidualTolerance &tolerance = touching.tolerance;
   Vector right_side(jacobian.Height());
   jacobian.Mult(touching.exact, right_side);
   Vector x(jacobian.Height());
   REQUIRE(solver.Solve(right_side, x, tolerance, 1.0).converged);
   const Vector guess(x);
   const int factorizations = solver.Work().factorizations;
   CHECK(factorizations > 0);

   // Multigrid's exact solves would be others for other operators.
   solver.ContactMoved();
   BiphasicLinearSolver::Result result =
      solver.Solve(right_side, x, tolerance, 10.0, FirstGuess::given);
   CHECK(result.converged);
   CHECK(result.iterations == 0);
   CHECK(solver.Work().factorizations == factorizations);
   x -= guess;
   CHECK(bodies.Dot(x, x) <= 1e-28 * bodies.Dot(guess, guess));

   // Another right side has another solution.
   right_side *= 1.5;
   x = guess;
   result = solver.Solve(right_side, x, tolerance, 10.0, FirstGuess::given);
   CHECK(result.converged);
   CHECK(result.iterations > 0);
   const bool follows = method == LinearMethod::block_amg;
   CHECK((solver.Work().factorizations > factorizations) == follows);
   touching.CheckSolution(x, 1.5);
}

TEST_CASE("Multipliers that are solved for close gaps as larger penalties do")
{
   constexpr real_t compliance = 0.05;
   const LinearMethod method =
      GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   const Bodies bodies(2);
   ComplexContact contact(bodies);
   const ContactFactors &factors = contact.terms[0];
   const Array<int> &offsets = bodies.spaces.Offsets();
   const Array<int> u_dofs = bodies.Prescribed(bodies.spaces.Displacement());
   const Array<int> p_dofs = bodies.Prescribed(bodies.spaces.Pressure());
   BiphasicJacobian jacobian(*bodies.matrices, offsets, u_dofs, contact.terms);
   jacobian.SetTimeStep(dt);
   jacobian.SetPressureDofs(p_dofs);
   LinearOptions options;
   options.method = method;
   BiphasicLinearSolver solver(jacobian, bodies.spaces, options);
   CAPTURE(static_cast<int>(method));
   Vector b = bodies.Random(1);
   SetToZero(u_dofs, 0, b);
   SetToZero(p_dofs, offsets[1], b);
   ResidualTolerance tolerance;
   tolerance.momentum = 1e-10;
   tolerance.mass = 2e-10;
   Vector x(b.Size());
   MultiplierChanges changes;
   const BiphasicLinearSolver::Result result =
      solver.Solve(b, x, changes, compliance, tolerance, 1.0);
   CAPTURE(result.failure, result.iterations);
   REQUIRE(result.converged);
   CHECK(result.iterations <= 100);

   // The multipliers are what these penalties make of the gaps and jumps.
   const Vector u(x.GetData(), offsets[1]);
   const Vector p(x.GetData() + offsets[1], offsets[2] - offsets[1]);
   Vector forces(*factors.gap_values);
   factors.gap_change->Mult(1.0, u, 1.0, forces);
   forces *= *factors.gap_weights;
   forces /= compliance;
   Vector outflows(*factors.jump_values);
   factors.jump->Mult(1.0, p, 1.0, outflows);
   factors.jump_change->Mult(1.0, u, 1.0, outflows);
   outflows *= *factors.jump_weights;
   outflows /= compliance;
   const real_t size =
      std::sqrt(bodies.Dot(forces, forces) + bodies.Dot(outflows, outflows));
   CHECK(size > 0.0);
   forces -= changes.forces[0];
   outflows -= changes.outflows[0];
   CHECK(std::sqrt(bodies.Dot(forces, forces)) <= 1e-7 * size);
   CHECK(std::sqrt(bodies.Dot(outflows, outflows)) <= 1e-7 * size);

   // With what they do to the nodes, the equations hold.
   Vector left(b.Size());
   jacobian.Mult(x, left);
   Vector nodal(offsets[1]);
   factors.gap->MultTranspose(changes.forces[0], nodal);
   nodal.SetSubVector(u_dofs, 0.0);
   left.AddSubVector(nodal, 0);
   Vector leaving(offsets[2] - offsets[1]);
   factors.jump->MultTranspose(changes.outflows[0], leaving);
   leaving *= -dt;
   leaving.SetSubVector(p_dofs, 0.0);
   left.AddSubVector(leaving, offsets[1]);
   left -= b;
   CHECK(std::sqrt(bodies.Dot(left, left)) <=
         1e-8 * std::sqrt(bodies.Dot(b, b)));
}
