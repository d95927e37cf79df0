// ranks: 1 2 3 4
// timeout: 300
//
// The Jacobian of two bodies that are partly in contact, partly apart, partly
// sealed and partly drained, against differences of the equations that it
// claims to linearize:
//
//     momentum:  K u - B^T p - contact forces
//     mass:      B u + (dt L + S) p + dt x fluid exchanged in contact

#include "support/boxes.hpp"
#include "synovia/linalg/biphasic_linear_solver.hpp"
#include "synovia/synovia.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace mfem;
using namespace synovia;

namespace
{
constexpr real_t dt = 3.0;

// Differences: the equations are linear between the switches of vertices, so
// that only round-off is left, which a larger step makes smaller.
constexpr real_t difference_step = 1e-5;
constexpr real_t difference_tolerance = 1e-7;

class Bodies
{
public:
   explicit Bodies(int order)
      : mesh(MakeMesh()), spaces(mesh.Get(), order), lower_solid(0.5, 0.1),
        upper_solid(2.0, 0.3), lower_fluid(4.0e-3), upper_fluid(1.0e-3)
   {
      materials.Set(mesh.Region("lower"), {&lower_solid, &lower_fluid, 0.2});
      materials.Set(mesh.Region("upper"), {&upper_solid, &upper_fluid, 0.2});
      ContactOptions options;
      options.search_radius = 0.5;
      pair = std::make_unique<ContactPair>("pair", spaces, materials,
                                           mesh.Boundary("upper_z0"),
                                           mesh.Boundary("lower_z1"), options);
      matrices = std::make_unique<VolumeMatrices>(spaces, materials);

      state.SetSize(spaces.Offsets().Last());
      state.Randomize(3 + Mpi::WorldRank());
      state *= 1e-4;
      // The upper body overlaps the lower one for x < 0.5 and lifts off beyond.
      VectorFunctionCoefficient tilt(3,
                                     [](const Vector &x, Vector &u)
                                     {
                                        u = 0.0;
                                        u[2] = x[2] > 1.0 - 1e-8
                                                  ? 0.1 * (x[0] - 0.5)
                                                  : 0.0;
                                     });
      PWVectorCoefficient on_upper(3);
      on_upper.UpdateCoefficient(2, tilt);
      ParGridFunction field(&spaces.Displacement());
      field.ProjectCoefficient(on_upper);
      Vector u;
      field.GetTrueDofs(u);
      for (int i = 0; i < u.Size(); i++)
      {
         state[i] += u[i];
      }
      Vector x(Displacement(state));
      pair->Search(x);
      // Multipliers that are not zero.
      Evaluate(state);
      pair->Enforcement().Augment();
      Evaluate(state);
      contact.push_back(pair->Factors());
   }

   Vector Displacement(const Vector &x) const
   {
      Vector u(spaces.Offsets()[1]);
      for (int i = 0; i < u.Size(); i++)
      {
         u[i] = x[i];
      }
      return u;
   }

   Vector Pressure(const Vector &x) const
   {
      const int begin = spaces.Offsets()[1];
      Vector p(x.Size() - begin);
      for (int i = 0; i < p.Size(); i++)
      {
         p[i] = x[begin + i];
      }
      return p;
   }

   // Says whether a vertex switched.
   bool Evaluate(const Vector &x)
   {
      pair->Enforcement().Evaluate(Displacement(x), Pressure(x));
      return pair->Enforcement().UpdateActiveSet();
   }

   // The left sides, the mass balance with the sign of the Jacobian.
   Vector Equations(const Vector &x, bool with_bodies)
   {
      CHECK_FALSE(Evaluate(x));
      const Vector u = Displacement(x);
      const Vector p = Pressure(x);
      Vector forces(u.Size());
      Vector exchange(p.Size());
      forces = 0.0;
      exchange = 0.0;
      pair->AddForces(forces, exchange);
      BlockVector result(spaces.Offsets());
      Vector &momentum = result.GetBlock(0);
      Vector &mass = result.GetBlock(1);
      momentum = 0.0;
      mass = 0.0;
      if (with_bodies)
      {
         matrices->stiffness->Mult(u, momentum);
         matrices->divergence_transpose->Mult(-1.0, p, 1.0, momentum);
         matrices->divergence->Mult(u, mass);
         matrices->darcy->Mult(dt, p, 1.0, mass);
         if (matrices->stabilization)
         {
            matrices->stabilization->Mult(1.0, p, 1.0, mass);
         }
      }
      momentum -= forces;
      mass.Add(dt, exchange);
      mass.Neg();
      return result;
   }

   real_t Dot(const Vector &x, const Vector &y) const
   {
      return InnerProduct(mesh.GetComm(), x, y);
   }

   // Counts over all ranks: in contact, sealed, and seeing the source at all.
   std::array<int, 3> Counts() const
   {
      std::array<int, 3> counts{{0, 0, 0}};
      for (int j = 0; j < pair->Coverage().area.Size(); j++)
      {
         counts[0] += pair->State().vertices[j].touches;
         counts[1] += pair->State().jump_weights[j] > 0.0;
         counts[2] += pair->Coverage().area[j] > 0.0;
      }
      MPI_Allreduce(MPI_IN_PLACE, counts.data(), 3, MPI_INT, MPI_SUM,
                    mesh.GetComm());
      return counts;
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
      Vector x(state.Size());
      x.Randomize(seed + 17 * Mpi::WorldRank());
      for (int i = 0; i < x.Size(); i++)
      {
         x[i] = 2.0 * x[i] - 1.0;
      }
      return x;
   }

   NamedMesh mesh;
   mutable BiphasicSpaces spaces;
   IsotropicElastic lower_solid;
   IsotropicElastic upper_solid;
   ConstantPermeability lower_fluid;
   ConstantPermeability upper_fluid;
   MaterialTable materials;
   std::unique_ptr<ContactPair> pair;
   ContactTerms contact;
   std::unique_ptr<VolumeMatrices> matrices;
   Vector state;

private:
   static NamedMesh MakeMesh()
   {
      BoxOptions lower;
      lower.nx = 5;
      lower.ny = 5;
      lower.nz = 1;
      lower.type = Element::TETRAHEDRON;
      BoxOptions upper = lower;
      upper.nx = 3;
      upper.ny = 3;
      // The rim of the upper body covers some faces in part: in contact, but
      // not sealed.
      upper.size_y = 0.65;
      return MakeStack(lower, upper);
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

TEST_CASE("The Jacobian agrees with differences of the equations")
{
   const int order = GENERATE(1, 2);
   Bodies bodies(order);
   const Array<int> none;
   BiphasicJacobian jacobian(*bodies.matrices, bodies.spaces.Offsets(), none,
                             bodies.contact);
   jacobian.SetTimeStep(dt);
   const ContactTerms no_contact;
   BiphasicJacobian apart(*bodies.matrices, bodies.spaces.Offsets(), none,
                          no_contact);
   apart.SetTimeStep(dt);
   // With the bodies' own share and without, lest that hides an error.
   const bool with_bodies = GENERATE(true, false);
   CAPTURE(order, with_bodies);
   for (int seed = 1; seed <= 5; seed++)
   {
      const Vector direction = bodies.Random(seed);
      Vector ahead(bodies.state);
      Vector behind(bodies.state);
      ahead.Add(difference_step, direction);
      behind.Add(-difference_step, direction);
      Vector difference = bodies.Equations(ahead, with_bodies);
      difference -= bodies.Equations(behind, with_bodies);
      difference *= 0.5 / difference_step;

      BlockVector exact(bodies.spaces.Offsets());
      jacobian.Mult(direction, exact);
      if (!with_bodies)
      {
         BlockVector without(bodies.spaces.Offsets());
         apart.Mult(direction, without);
         exact -= without;
      }
      const auto compare = [&](const Vector &found, const Vector &wanted)
      {
         Vector error(found);
         error -= wanted;
         const real_t size = std::sqrt(bodies.Dot(wanted, wanted));
         CHECK(size > 0.0);
         CHECK(std::sqrt(bodies.Dot(error, error)) <=
               difference_tolerance * size);
      };
      compare(bodies.Displacement(difference), exact.GetBlock(0));
      compare(bodies.Pressure(difference), exact.GetBlock(1));
   }
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
   const Vector holding = jacobian.Holding();
   const auto assembled = jacobian.AssembleHeld(holding);
   Vector ax(bodies.state.Size());
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
   const auto assembled = jacobian.AssembleHeld(jacobian.Holding());
   Vector ax(bodies.state.Size());
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

TEST_CASE("Contact with all its changes is solved by either method")
{
   const LinearMethod method =
      GENERATE(LinearMethod::direct, LinearMethod::block_amg);
   const Bodies bodies(2);
   ComplexContact contact(bodies);
   const Array<int> &offsets = bodies.spaces.Offsets();
   BiphasicJacobian jacobian(*bodies.matrices, offsets,
                             bodies.Prescribed(bodies.spaces.Displacement()),
                             contact.terms);
   jacobian.SetTimeStep(dt);
   jacobian.SetPressureDofs(bodies.Prescribed(bodies.spaces.Pressure()));
   LinearOptions options;
   options.method = method;
   BiphasicLinearSolver solver(jacobian, bodies.spaces, options);
   const bool direct = method == LinearMethod::direct;
   CAPTURE(direct);
   const Vector exact = bodies.Random(1);
   Vector right_side(exact.Size());
   Vector found(exact.Size());
   ResidualTolerance tolerance;
   tolerance.momentum = tolerance.mass = 1e-9;
   for (const bool lifted : {false, true})
   {
      CAPTURE(lifted);
      if (lifted)
      {
         contact.LiftSome();
      }
      jacobian.Mult(exact, right_side);
      const BiphasicLinearSolver::Result result =
         solver.Solve(right_side, found, tolerance, 1.0);
      CAPTURE(result.failure, result.iterations);
      CHECK(result.converged);
      // What is kept of the factorization is exact.
      CHECK(result.iterations <= (direct ? 2 : 60));
      found -= exact;
      CHECK(std::sqrt(bodies.Dot(found, found)) <=
            1e-5 * std::sqrt(bodies.Dot(exact, exact)));
   }
   if (direct)
   {
      CHECK(solver.Work().factorizations == 1);
      CHECK(solver.Work().columns > 0);
   }
}
