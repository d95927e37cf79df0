#include "synovia/contact/contact_friction.hpp"
#include "synovia/contact/surface_normals.hpp"
#include "synovia/general/reduce.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// As often a vertex may turn from sticking to sliding, or back, in a stage.
constexpr int most_turns = 4;
// What a trial has above its limit says something if it is as many times what
// is out of balance.
constexpr real_t reliable_excess = 2.0;

using Unique = std::unique_ptr<HypreParMatrix>;

void AddScaled(const Vector &rows, const HypreParMatrix &matrix, Unique &sum)
{
   auto scaled = std::make_unique<HypreParMatrix>(matrix);
   scaled->ScaleRows(rows);
   sum = sum ? Unique(Add(1.0, *sum, 1.0, *scaled)) : std::move(scaled);
}

/// A 3 x 3 matrix at each vertex, as vectors over the vertices.
class VertexMatrices
{
public:
   explicit VertexMatrices(int vertices)
   {
      for (VectorByComponent &row : entries)
      {
         for (Vector &values : row)
         {
            values.SetSize(vertices);
            values = 0.0;
         }
      }
   }
   void Set(int vertex, const Matrix3 &matrix)
   {
      for (int i = 0; i < 3; i++)
      {
         for (int k = 0; k < 3; k++)
         {
            entries[i][k][vertex] = matrix[i][k];
         }
      }
   }
   /// Adds row @a i of the product with @a matrices.
   void AddProduct(int i, const MatrixByComponent &matrices, Unique &sum) const
   {
      for (int k = 0; k < 3; k++)
      {
         AddScaled(entries[i][k], *matrices[k], sum);
      }
   }

private:
   std::array<VectorByComponent, 3> entries;
};

Matrix3 Product(const Matrix3 &a, const Matrix3 &b)
{
   Matrix3 product{};
   for (int i = 0; i < 3; i++)
   {
      for (int k = 0; k < 3; k++)
      {
         product[i] = Sum(product[i], a[i][k], b[k]);
      }
   }
   return product;
}

Matrix3 Scaled(real_t s, const Matrix3 &a)
{
   Matrix3 scaled{};
   for (int i = 0; i < 3; i++)
   {
      scaled[i] = Sum(scaled[i], s, a[i]);
   }
   return scaled;
}

/// I - n n^T
Matrix3 Projector(const Point3 &n)
{
   Matrix3 projector;
   for (int i = 0; i < 3; i++)
   {
      Point3 unit{{0.0, 0.0, 0.0}};
      unit[i] = 1.0;
      projector[i] = Across(n, unit);
   }
   return projector;
}
} // namespace

ContactFriction::ContactFriction(FiniteConstraint &constraint_,
                                 const ContactSurface &destination_,
                                 const FrictionLaw &law_)
   : constraint(constraint_), destination(destination_), law(law_)
{
}

void ContactFriction::FindOrigin()
{
   if (origin_found)
   {
      return;
   }
   if (accepted_at.Size() == 0)
   {
      constraint.SearchReference();
      accepted_at = constraint.Displacement();
   }
   const std::unique_ptr<FiniteGap> there = constraint.FindGap(accepted_at);
   origin = there->FindSlidingMaps();
   origin_normal = there->Operators().normal_area;
   for (int j = 0; j < origin_normal[0].Size(); j++)
   {
      Point3 normal = FrictionState::At(origin_normal, j);
      const real_t length = Length(normal);
      const real_t scale = length > 0.0 ? 1.0 / length : 0.0;
      FrictionState::Set(origin_normal, j,
                         Sum({{0.0, 0.0, 0.0}}, scale, normal));
   }
   origin_found = true;
}

void ContactFriction::Accept(ContactState &state)
{
   if (evaluated_at.Size() == 0)
   {
      return;
   }
   FrictionState &friction = state.friction;
   const Vector &area = constraint.Coverage().area;
   for (int j = 0; j < area.Size(); j++)
   {
      // What sticks slips by less than the gap's tolerance, either way.
      if (friction.vertices[j].slides)
      {
         friction.dissipation +=
            area[j] * Dot(FrictionState::At(friction.traction, j),
                          FrictionState::At(friction.slip, j));
      }
   }
   for (Vector &component : friction.slip)
   {
      component = 0.0;
   }
   friction.multiplier = friction.traction;
   accepted_at = evaluated_at;
   evaluated_at.SetSize(0);
   origin_found = false;
}

void ContactFriction::SetOrigin(const Vector &u)
{
   accepted_at = u;
   origin_found = false;
}

void ContactFriction::Archive(StateArchive &archive, const std::string &prefix)
{
   ParFiniteElementSpace &space = destination.Spaces().Displacement();
   Vector at(accepted_at.Size() > 0 ? accepted_at : constraint.Displacement());
   if (at.Size() == 0)
   {
      at.SetSize(space.GetTrueVSize());
      at = 0.0;
   }
   archive.Field(prefix + "slip_origin", space, at);
   if (archive.Reads())
   {
      SetOrigin(at);
   }
}

void ContactFriction::StartStage(FrictionState &state)
{
   linearized = false;
   decided = false;
   for (VertexSlip &vertex : state.vertices)
   {
      vertex.turns = 0;
      vertex.elastic = false;
      vertex.turned_round = false;
   }
}

void ContactFriction::Evaluate(const Vector &u, const Vector &p,
                               FrictionState &state)
{
   // On a first approach only gaps are looked at.
   if (!origin_found)
   {
      return;
   }
   evaluated_at = u;
   present = constraint.Gap().FindSlidingMaps();
   Vector motion(u);
   motion -= accepted_at;
   Vector by_present(state.pressure.Size());
   for (int c = 0; c < 3; c++)
   {
      state.distance[c] = origin.mean_distance[c];
      origin.distance[c]->Mult(1.0, motion, 1.0, state.distance[c]);
      state.distance[c].HostReadWrite();
      present.distance[c]->Mult(motion, by_present);
      by_present.HostRead();
      for (int j = 0; j < by_present.Size(); j++)
      {
         if (!HasOrigin(j))
         {
            state.distance[c][j] = by_present[j];
         }
      }
   }
   present.pressure->Mult(p, state.pressure);
   state.pressure.HostRead();
   const VectorByComponent &normal_area = constraint.Coverage().normal_area;
   for (int j = 0; j < state.pressure.Size(); j++)
   {
      const Point3 sum = FrictionState::At(normal_area, j);
      const real_t length = Length(sum);
      const real_t scale = length > 0.0 ? 1.0 / length : 0.0;
      state.normal_length[j] = length;
      FrictionState::Set(state.normal, j, Sum({{0.0, 0.0, 0.0}}, scale, sum));
      const Point3 start = Across(FrictionState::At(origin_normal, j),
                                  FrictionState::At(origin.mean_distance, j));
      const Point3 normal = FrictionState::At(state.normal, j);
      FrictionState::Set(
         state.slip, j,
         Sum(Across(normal, FrictionState::At(state.distance, j)), -1.0,
             Turn(state, j)(start)));
   }
}

Point3 ContactFriction::Carried(const FrictionState &state, int vertex,
                                real_t stiffness) const
{
   return Across(FrictionState::At(origin_normal, vertex),
                 Sum(FrictionState::At(state.multiplier, vertex), -stiffness,
                     FrictionState::At(origin.mean_distance, vertex)));
}

Point3 ContactFriction::Trial(const FrictionState &state, int vertex,
                              real_t stiffness) const
{
   const Point3 moved = Across(FrictionState::At(state.normal, vertex),
                               FrictionState::At(state.distance, vertex));
   return Sum(Turn(state, vertex)(Carried(state, vertex, stiffness)), stiffness,
              moved);
}

ContactFriction::Response ContactFriction::Respond(const FrictionState &state,
                                                   int vertex, real_t normal,
                                                   real_t stiffness,
                                                   real_t penalty) const
{
   const VertexSlip &how = state.vertices[vertex];
   const real_t limit = how.lags ? lagged_limit[vertex]
                                 : law.Limit(normal, state.pressure[vertex]);
   const Point3 trial = Trial(state, vertex, how.elastic ? penalty : stiffness);
   const real_t length = Length(trial);
   Response response;
   if (how.elastic ? how.turned_round || !(length > limit) : !how.slides)
   {
      response.sticks = true;
      response.traction = trial;
      response.by_trial = Scaled(
         1.0, {{{{1.0, 0.0, 0.0}}, {{0.0, 1.0, 0.0}}, {{0.0, 0.0, 1.0}}}});
      return response;
   }
   if (!(length > 0.0) || !(limit > 0.0))
   {
      return response;
   }
   const Point3 along = Sum({{0.0, 0.0, 0.0}}, 1.0 / length, trial);
   response.traction = Sum({{0.0, 0.0, 0.0}}, limit, along);
   response.by_trial =
      Scaled(std::min<real_t>(1.0, limit / length), Projector(along));
   if (!how.lags)
   {
      response.by_limit = along;
   }
   return response;
}

void ContactFriction::LagLimits(const Vector &normal, const Vector &pressing,
                                ContactState &state)
{
   // A penalty makes many times the traction of a gap that is still open.
   constexpr real_t much = 0.5;
   FrictionState &friction = state.friction;
   lagged_limit.SetSize(normal.Size());
   for (int j = 0; j < normal.Size(); j++)
   {
      lagged_limit[j] = law.Limit(normal[j], friction.pressure[j]);
      friction.vertices[j].lags =
         state.vertices[j].touches &&
         std::abs(pressing[j] - normal[j]) > much * std::abs(normal[j]);
   }
}

void ContactFriction::PredictSliding(const Vector &normal,
                                     const std::vector<VertexContact> &before,
                                     const Vector &stiffness,
                                     ContactState &state)
{
   FrictionState &friction = state.friction;
   for (std::size_t i = 0; i < before.size(); i++)
   {
      VertexSlip &vertex = friction.vertices[i];
      const int j = static_cast<int>(i);
      if (!state.vertices[i].touches)
      {
         vertex.slides = false;
      }
      else if (!before[i].touches)
      {
         // Held where it goes on to slide, it would shear the bodies to pieces.
         vertex.slides = Length(Trial(friction, j, stiffness[j])) >
                         law.Limit(normal[j], friction.pressure[j]);
      }
   }
   sliding_changed = false;
}

bool ContactFriction::UpdateSliding(const Vector &normal,
                                    const std::vector<VertexContact> &before,
                                    const Vector &stiffness,
                                    const Vector &penalty, real_t imbalance,
                                    ContactState &state)
{
   // The first trials of a stage are those of a guess, and what is released
   // against its slip takes its neighbors along.
   const real_t doubtful = decided ? 0.0 : reliable_excess * imbalance;
   decided = true;
   const Vector &area = constraint.Coverage().area;
   bool changed = false;
   bool waits = false;
   FrictionState &friction = state.friction;
   for (std::size_t i = 0; i < before.size(); i++)
   {
      VertexSlip &vertex = friction.vertices[i];
      const int j = static_cast<int>(i);
      const bool slid = vertex.slides;
      const bool turned_round = vertex.turned_round;
      vertex.turned_round = false;
      if (!state.vertices[i].touches)
      {
         vertex.slides = false;
         continue;
      }
      const real_t limit = law.Limit(normal[j], friction.pressure[j]);
      const Point3 trial =
         Trial(friction, j, vertex.elastic ? penalty[j] : stiffness[j]);
      const real_t excess = Length(trial) - limit;
      const bool doubts =
         before[i].touches && !slid && area[j] * excess < doubtful;
      waits = waits || (doubts && excess > 0.0);
      const bool slides = excess > 0.0 && !doubts;
      // Nothing resists along the slip that there was: it would go to and fro.
      vertex.turned_round =
         slides && linearized && slid_when_linearized[i] &&
         Dot(trial, FrictionState::At(linearized_traction, j)) < 0.0;
      vertex.slides = slides && !vertex.turned_round;
      if (before[i].touches && vertex.slides != slid && !vertex.elastic)
      {
         changed = true;
         vertex.turns++;
         vertex.elastic = vertex.turns > most_turns;
      }
      changed = changed || vertex.turned_round || turned_round;
   }
   MPI_Comm comm = destination.Spaces().GetComm();
   sliding_changed = AnyRank(changed, comm);
   return AnyRank(changed || waits, comm);
}

void ContactFriction::UpdateTractions(const Vector &stiffness,
                                      const Vector &penalty,
                                      ContactState &state) const
{
   FrictionState &friction = state.friction;
   for (int j = 0; j < stiffness.Size(); j++)
   {
      const Point3 none{{0.0, 0.0, 0.0}};
      FrictionState::Set(
         friction.traction, j,
         state.vertices[j].touches
            ? Respond(friction, j, state.traction[j], stiffness[j], penalty[j])
                 .traction
            : none);
   }
}

void ContactFriction::TakeMultipliers(FrictionState &state) const
{
   for (int j = 0; j < state.pressure.Size(); j++)
   {
      const TangentialTurn back(FrictionState::At(state.normal, j),
                                FrictionState::At(origin_normal, j));
      FrictionState::Set(state.multiplier, j,
                         back(FrictionState::At(state.traction, j)));
   }
}

void ContactFriction::AddForces(const FrictionState &state, const Vector &area,
                                Vector &momentum) const
{
   Vector force(momentum.Size());
   for (int c = 0; c < 3; c++)
   {
      Vector nodal_force(area);
      nodal_force *= state.traction[c];
      present.distance[c]->MultTranspose(nodal_force, force);
      momentum -= force;
   }
}

void ContactFriction::Linearize(const Vector &p, const ContactFactors &gaps,
                                const Vector &area, const Vector &penalty,
                                const Vector &area_resistance,
                                const ContactState &state)
{
   const FrictionState &friction = state.friction;
   const int size = area.Size();
   // Per area, as the nodal forces are.
   Vector soft_penalty(size);
   soft_penalty = 0.0;
   linearized_traction = friction.traction;
   slid_when_linearized.assign(size, false);
   linearized = true;
   VectorByComponent nodal_force(friction.traction);
   for (Vector &component : nodal_force)
   {
      component *= area;
   }
   const SlidingChanges changes =
      constraint.Gap().FindSlidingChanges(p, nodal_force);
   VertexMatrices by_distance(size);
   VertexMatrices by_present_distance(size);
   bool any_without_origin = false;
   VertexMatrices by_normal_area(size);
   VectorByComponent by_gap{Vector(size), Vector(size), Vector(size)};
   VectorByComponent by_fluid(by_gap);
   for (int j = 0; j < size; j++)
   {
      FrictionState::Set(by_gap, j, {{0.0, 0.0, 0.0}});
      FrictionState::Set(by_fluid, j, {{0.0, 0.0, 0.0}});
      if (!state.vertices[j].touches)
      {
         continue;
      }
      const Response response =
         Respond(friction, j, state.traction[j], penalty[j], penalty[j]);
      FrictionState::Set(linearized_traction, j, response.traction);
      slid_when_linearized[j] = !response.sticks;
      if (response.sticks && area[j] > 0.0)
      {
         soft_penalty[j] = std::min(penalty[j], area_resistance[j] / area[j]);
      }
      const Point3 normal = FrictionState::At(friction.normal, j);
      const Point3 distance = FrictionState::At(friction.distance, j);
      const Matrix3 across = Projector(normal);
      (HasOrigin(j) ? by_distance : by_present_distance)
         .Set(j, Product(response.by_trial, Scaled(penalty[j], across)));
      any_without_origin = any_without_origin || !HasOrigin(j);
      Matrix3 turn =
         Turn(friction, j).Derivative(Carried(friction, j, penalty[j]));
      for (int i = 0; i < 3; i++)
      {
         turn[i] = Sum(turn[i], -penalty[j] * normal[i], distance);
         turn[i][i] -= penalty[j] * Dot(normal, distance);
      }
      by_normal_area.Set(
         j, Product(
               response.by_trial,
               Product(turn, Scaled(1.0 / friction.normal_length[j], across))));
      for (int c = 0; c < 3; c++)
      {
         by_gap[c][j] = response.by_limit[c] * law.ByTraction() * penalty[j];
         by_fluid[c][j] = response.by_limit[c] * law.ByPressure();
      }
   }
   any_without_origin =
      AnyRank(any_without_origin, destination.Spaces().GetComm());
   force_by_pressure.reset();
   force_change.reset();
   soft_force_change.reset();
   Unique soft_sum = std::make_unique<HypreParMatrix>(*gaps.force_change);
   Unique sum = std::make_unique<HypreParMatrix>(*gaps.force_change);
   sum.reset(Add(1.0, *sum, 1.0, *changes.force));
   for (int c = 0; c < 3; c++)
   {
      by_displacement[c].reset();
      by_pressure[c].reset();
      by_distance.AddProduct(c, origin.distance, by_displacement[c]);
      if (any_without_origin)
      {
         by_present_distance.AddProduct(c, present.distance,
                                        by_displacement[c]);
      }
      by_normal_area.AddProduct(c, changes.normal_area, by_displacement[c]);
      AddScaled(by_gap[c], *gaps.gap_change, by_displacement[c]);
      AddScaled(by_fluid[c], *changes.pressure, by_displacement[c]);
      AddScaled(by_fluid[c], *present.pressure, by_pressure[c]);
      HypreParMatrix forces(*present.distance[c]);
      forces.ScaleRows(area);
      const Unique transpose(forces.Transpose());
      const Unique by_u(
         ParMult(transpose.get(), by_displacement[c].get(), true));
      sum.reset(Add(1.0, *sum, 1.0, *by_u));
      HypreParMatrix soft_tractions(*present.distance[c]);
      soft_tractions.ScaleRows(soft_penalty);
      const Unique held(ParMult(transpose.get(), &soft_tractions, true));
      soft_sum.reset(Add(1.0, *soft_sum, 1.0, *held));
      Unique by_p(ParMult(transpose.get(), by_pressure[c].get(), true));
      force_by_pressure = force_by_pressure
                             ? Unique(Add(1.0, *force_by_pressure, 1.0, *by_p))
                             : std::move(by_p);
   }
   force_change = std::move(sum);
   soft_force_change = std::move(soft_sum);
}

VectorByComponent
ContactFriction::FindMultiplierStep(const Vector &du, const Vector &dp,
                                    const Vector &normal, const Vector &penalty,
                                    const ContactState &state) const
{
   const FrictionState &friction = state.friction;
   VectorByComponent step(friction.multiplier);
   for (int c = 0; c < 3; c++)
   {
      by_displacement[c]->Mult(du, step[c]);
      by_pressure[c]->Mult(1.0, dp, 1.0, step[c]);
      step[c].HostReadWrite();
   }
   for (int j = 0; j < penalty.Size(); j++)
   {
      Point3 after{{0.0, 0.0, 0.0}};
      if (friction.vertices[j].elastic)
      {
         FrictionState::Set(step, j, after);
         continue;
      }
      if (state.vertices[j].touches)
      {
         const TangentialTurn back(FrictionState::At(friction.normal, j),
                                   FrictionState::At(origin_normal, j));
         after = Sum(
            FrictionState::At(step, j), 1.0,
            Respond(friction, j, normal[j], penalty[j], penalty[j]).traction);
         after = back(Across(FrictionState::At(friction.normal, j), after));
      }
      FrictionState::Set(
         step, j, Sum(after, -1.0, FrictionState::At(friction.multiplier, j)));
   }
   return step;
}

real_t ContactFriction::FindViolation(const Vector &normal,
                                      const Vector &penalty,
                                      const ContactState &state) const
{
   const FrictionState &friction = state.friction;
   real_t worst = 0.0;
   for (int j = 0; j < penalty.Size(); j++)
   {
      if (state.vertices[j].touches && !friction.vertices[j].elastic)
      {
         const Point3 traction =
            Respond(friction, j, normal[j], penalty[j], penalty[j]).traction;
         const Point3 held = Turn(friction, j)(Carried(friction, j, 0.0));
         worst =
            std::max(worst, Length(Sum(traction, -1.0, held)) / penalty[j]);
      }
   }
   return worst;
}

} // namespace synovia
