#include "synovia/contact/contact_pair.hpp"
#include "synovia/contact/adjacent_layer.hpp"
#include "synovia/fem/node_positions.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// A destination vertex seals only where the source covers it all around: one at
// the rim of the source touches the free-draining surface, where p = 0.
constexpr real_t sealing_coverage = 0.75;
// A source vertex is sealed where the contact covers more than this of it.
constexpr real_t source_coverage = 0.5;
// A destination vertex of which the source covers less than this is left out:
// the sliver could bear only a needle of traction.
constexpr real_t least_coverage = 0.05;

void VerifyOptions(const std::string &name, const ContactOptions &options)
{
   const auto verify = [&](bool good, const char *what, real_t value)
   {
      if (!good)
      {
         throw Error("contact pair \"" + name + "\": " + what + " is " +
                     ToText(value) + "; it must be positive, or 0 (derived)");
      }
   };
   verify(options.penalty >= 0.0, "penalty", options.penalty);
   verify(options.pressure_penalty >= 0.0, "pressure_penalty",
          options.pressure_penalty);
   verify(options.gap_tolerance >= 0.0, "gap_tolerance", options.gap_tolerance);
   verify(options.search_radius >= 0.0, "search_radius", options.search_radius);
   verify(options.overlap_limit >= 0.0, "overlap_limit", options.overlap_limit);
   verify(options.penalty_factor > 0.0, "penalty_factor",
          options.penalty_factor);
   verify(options.pressure_tolerance > 0.0, "pressure_tolerance",
          options.pressure_tolerance);
   verify(options.quadrature_order > 0, "quadrature_order",
          options.quadrature_order);
   // Functions with kinks need a rule with positive weights.
   const IntegrationRule &rule =
      IntRules.Get(Geometry::TRIANGLE, options.quadrature_order);
   if (rule.GetWeights().Min() < 0.0)
   {
      throw Error("contact pair \"" + name + "\": quadrature_order is " +
                  std::to_string(options.quadrature_order) +
                  ", for which MFEM's rule on triangles has negative weights; "
                  "it must be between 1 and 25, but not 3");
   }
}
} // namespace

ContactPair::ContactPair(const std::string &name_, BiphasicSpaces &spaces,
                         const MaterialTable &materials,
                         const Array<int> &source_boundary,
                         const Array<int> &destination_boundary_,
                         const ContactOptions &options_)
   : name(name_), comm(spaces.GetComm()), options(options_),
     destination_boundary(destination_boundary_),
     source(spaces, source_boundary), destination(spaces, destination_boundary)
{
   VerifyOptions(name, options);
   const AdjacentLayer source_layer(spaces.GetMesh(), source_boundary);
   const AdjacentLayer layer(spaces.GetMesh(), destination_boundary);
   if (!(source_layer.area > 0.0) || !(layer.area > 0.0))
   {
      throw Error("contact pair \"" + name + "\": its " +
                  (source_layer.area > 0.0 ? "destination" : "source") +
                  " has no faces");
   }
   int shared = 0;
   for (const int dof : source.MultiplierTrueDofs())
   {
      shared += destination.MultiplierTrueDofs().FindSorted(dof) >= 0;
   }
   if (AnyRank(shared > 0, comm))
   {
      throw Error("contact pair \"" + name +
                  "\": source and destination share vertices; the two bodies "
                  "must have meshes of their own, without common nodes");
   }
   softest_modulus = std::min(source_layer.SoftestModulus(materials),
                              layer.SoftestModulus(materials));
   least_permeability = std::min(source_layer.LeastPermeability(materials),
                                 layer.LeastPermeability(materials));
   gap_tolerance = options.gap_tolerance > 0.0 ? options.gap_tolerance
                                               : 1e-5 * layer.Thickness();
   overlap_limit = options.overlap_limit > 0.0 ? options.overlap_limit
                                               : 0.1 * layer.Thickness();
   gap_options.search_radius =
      options.search_radius > 0.0 ? options.search_radius : layer.Thickness();
   gap_options.quadrature_order = options.quadrature_order;
   gap_options.normal = options.normal;
   reference_positions = NodePositions(spaces.Displacement());
   searched_positions = reference_positions;
   source_areas = NodalAreas(source);
   destination_areas = NodalAreas(destination);

   const int size = spaces.Multiplier().GetTrueVSize();
   for (Vector *v :
        {&resistance, &penalty, &pressure_penalty, &multiplier,
         &flux_multiplier, &stored.multiplier[0], &stored.multiplier[1],
         &stored.flux_multiplier[0], &stored.flux_multiplier[1],
         &removed_overlap, &gap, &jump, &pressure, &traction, &flux, &active,
         &sealing, &gap_weights, &jump_weights})
   {
      v->SetSize(size);
      *v = 0.0;
   }
   gap_resistance.SetSize(size);
   gap_resistance = 0.0;
   pressure_held.SetSize(size);
   pressure_held = false;
   seal_opened.SetSize(size);
   seal_opened = false;
   Accept();
}

void ContactPair::SetHeldPressures(const Array<int> &vertices)
{
   pressure_held = false;
   for (const int vertex : vertices)
   {
      pressure_held[vertex] = true;
   }
}

void ContactPair::SetTimeStep(real_t dt)
{
   // Steps that end on a corner differ by round-off.
   if (std::abs(dt - time_step) > 1e-6 * dt)
   {
      time_step = dt;
      if (searched)
      {
         SetPenalties();
      }
   }
}

bool ContactPair::Search(const Vector &u)
{
   if (!reached)
   {
      LookAsMeshed();
      VerifyReach();
      reached = true;
   }
   if (options.configuration == SearchConfiguration::current)
   {
      LookAt(u);
   }
   else if (searched)
   {
      return false;
   }
   else if (!operators.gap)
   {
      Assemble();
   }
   searched = true;
   SetPenalties();
   return true;
}

void ContactPair::Assemble()
{
   operators = AssembleGapOperators(source, destination, gap_options);
   for (int j = 0; j < operators.area.Size(); j++)
   {
      if (operators.area[j] < least_coverage * destination_areas[j])
      {
         operators.area[j] = 0.0;
      }
   }
}

void ContactPair::LookAt(const Vector &u)
{
   u.HostRead();
   source.SetDisplacement(u);
   destination.SetDisplacement(u);
   add(reference_positions, u, searched_positions);
   Assemble();
}

void ContactPair::VerifyReach() const
{
   if (!(SumOverRanks(operators.area.Sum(), comm) > 0.0))
   {
      throw Error("contact pair \"" + name +
                  "\": looking along the normals of the destination, no point "
                  "of the source is within the search radius of " +
                  ToText(gap_options.search_radius) +
                  "; check the names of the surfaces and the initial gap, or "
                  "give a larger search_radius");
   }
}

void ContactPair::LookAsMeshed()
{
   if (operators.gap)
   {
      return;
   }
   Assemble();
   real_t deepest = 0.0;
   for (int j = 0; j < operators.area.Size(); j++)
   {
      if (operators.area[j] > 0.0)
      {
         const real_t overlap = std::max(0.0, -operators.gap_offset[j]);
         deepest = std::max(deepest, overlap);
         if (options.initial_overlap == InitialOverlap::remove)
         {
            removed_overlap[j] = overlap;
         }
      }
   }
   deepest = MaxOverRanks(deepest, comm);
   if (deepest > overlap_limit)
   {
      throw Error(
         "contact pair \"" + name + "\": the surfaces overlap by up to " +
         ToText(deepest) +
         " as meshed, more than overlap_limit = " + ToText(overlap_limit) +
         "; move the bodies apart in the mesh, or allow for more");
   }
}

void ContactPair::SetPenalties()
{
   for (int j = 0; j < penalty.Size(); j++)
   {
      const real_t h = operators.face_size[j];
      const real_t area = operators.area[j];
      penalty[j] = stiffening.gap * options.penalty;
      resistance[j] =
         area > 0.0 ? softest_modulus / h * destination_areas[j] / area : 0.0;
      gap_resistance[j] = area * resistance[j];
      pressure_penalty[j] = stiffening.jump * options.pressure_penalty;
      if (area > 0.0 && options.penalty == 0.0)
      {
         // As stiff on the whole where the source covers only a part.
         penalty[j] = stiffening.gap * options.penalty_factor * resistance[j];
      }
      if (area > 0.0 && options.pressure_penalty == 0.0)
      {
         pressure_penalty[j] =
            stiffening.jump * options.penalty_factor *
            (least_permeability / h + h / (softest_modulus * time_step));
      }
   }
}

void ContactPair::Evaluate(const Vector &u, const Vector &p)
{
   operators.gap->Mult(u, gap);
   operators.jump->Mult(p, jump);
   p.HostRead();
   Vector destination_pressure(p.Size());
   destination_pressure = 0.0;
   for (const int dof : destination.PressureTrueDofs())
   {
      destination_pressure[dof] = -p[dof];
   }
   operators.jump->Mult(destination_pressure, pressure);
   gap.HostReadWrite();
   jump.HostRead();
   pressure.HostRead();
   for (int j = 0; j < gap.Size(); j++)
   {
      gap[j] += operators.gap_offset[j] +
                (operators.area[j] > 0.0 ? removed_overlap[j] : 0.0);
   }
}

real_t ContactPair::TouchingGap() const
{
   real_t nearest = std::numeric_limits<real_t>::infinity();
   for (int j = 0; j < gap.Size(); j++)
   {
      if (operators.area[j] > 0.0 && gap[j] < GrazingGap(j))
      {
         nearest = std::min(nearest, gap[j]);
      }
   }
   nearest = -MaxOverRanks(-nearest, comm);
   return std::isfinite(nearest) ? std::max(gap_tolerance, nearest)
                                 : gap_tolerance;
}

void ContactPair::UpdateTractions()
{
   for (int j = 0; j < active.Size(); j++)
   {
      traction[j] = active[j] > 0.5 ? multiplier[j] + penalty[j] * gap[j] : 0.0;
      flux[j] = Exchanges(j)
                   ? flux_multiplier[j] + pressure_penalty[j] * jump[j]
                   : 0.0;
   }
}

bool ContactPair::UpdateActiveSet()
{
   bool changed = false;
   const real_t touching = assume_touching ? TouchingGap() : 0.0;
   for (int j = 0; j < active.Size(); j++)
   {
      const real_t area = operators.area[j];
      // A predicted gap is off by more than what penetrates.
      const real_t stiffness =
         predicting ? std::min(penalty[j], resistance[j]) : penalty[j];
      const real_t trial = multiplier[j] + stiffness * gap[j];
      const bool touches =
         area > 0.0 &&
         (trial < 0.0 || (assume_touching && gap[j] <= touching) ||
          (release_nothing && active[j] > 0.5));
      const bool seals = area > 0.0 &&
                         area > sealing_coverage * destination_areas[j] &&
                         (touches || gap[j] < gap_tolerance ||
                          (sealing[j] > 0.5 && seal_opened[j]));
      seal_opened[j] = seal_opened[j] || (sealing[j] > 0.5 && !seals);
      changed =
         changed || touches != (active[j] > 0.5) || seals != (sealing[j] > 0.5);
      active[j] = touches ? 1.0 : 0.0;
      sealing[j] = seals ? 1.0 : 0.0;
      gap_weights[j] = touches ? area * penalty[j] : 0.0;
      jump_weights[j] = Exchanges(j) ? area * pressure_penalty[j] : 0.0;
   }
   assume_touching = false;
   release_nothing = false;
   predicting = false;
   UpdateTractions();
   return AnyRank(changed, comm);
}

Vector ContactPair::SealedVertices() const
{
   Vector covered(sealing.Size());
   operators.coverage->Mult(sealing, covered);
   covered.HostReadWrite();
   for (int k = 0; k < covered.Size(); k++)
   {
      const bool sealed =
         sealing[k] > 0.5 ||
         (covered[k] > 0.0 && covered[k] > source_coverage * source_areas[k]);
      covered[k] = sealed ? 1.0 : 0.0;
   }
   return covered;
}

void ContactPair::AddForces(Vector &momentum, Vector &mass) const
{
   Vector nodal_force(gap.Size());
   Vector nodal_flux(gap.Size());
   for (int j = 0; j < gap.Size(); j++)
   {
      nodal_force[j] = operators.area[j] * traction[j];
      nodal_flux[j] = operators.area[j] * flux[j];
   }
   Vector force(momentum.Size());
   Vector outflow(mass.Size());
   operators.gap->MultTranspose(nodal_force, force);
   operators.jump->MultTranspose(nodal_flux, outflow);
   momentum -= force;
   mass += outflow;
}

void ContactPair::AddMagnitudes(const Vector &u, const Vector &p,
                                Vector &momentum, Vector &mass) const
{
   Vector rows(gap.Size());
   operators.gap->AbsMult(1.0, u, 0.0, rows);
   rows *= gap_weights;
   operators.gap->AbsMultTranspose(1.0, rows, 1.0, momentum);
   operators.jump->AbsMult(1.0, p, 0.0, rows);
   rows *= jump_weights;
   operators.jump->AbsMultTranspose(1.0, rows, 1.0, mass);
}

ContactFactors ContactPair::Factors() const
{
   ContactFactors factors;
   factors.gap = factors.gap_change = operators.gap.get();
   factors.jump = operators.jump.get();
   factors.gap_weights = &gap_weights;
   factors.jump_weights = &jump_weights;
   factors.gap_resistance = &gap_resistance;
   return factors;
}

Vector ContactPair::SoftGapWeights() const
{
   Vector weights(gap_weights);
   for (int j = 0; j < weights.Size(); j++)
   {
      weights[j] = std::min(weights[j], operators.area[j] * resistance[j]);
   }
   return weights;
}

bool ContactPair::Converged(real_t peak_pressure) const
{
   const Violations now = WorstViolations();
   return now.penetration <= gap_tolerance &&
          now.pressure_jump <= options.pressure_tolerance * peak_pressure;
}

void ContactPair::Augment()
{
   TakeMultipliers();
   release_nothing = true;
}

void ContactPair::TakeMultipliers()
{
   for (int j = 0; j < multiplier.Size(); j++)
   {
      multiplier[j] = traction[j];
      flux_multiplier[j] = flux[j];
   }
}

void ContactPair::StartStage()
{
   last_penetration = std::numeric_limits<real_t>::infinity();
   last_jump = std::numeric_limits<real_t>::infinity();
   seal_opened = false;
   predicting = true;
}

bool ContactPair::StiffenIfSlow(real_t peak_pressure)
{
   // What an augmentation should at least do (Simo & Laursen, Comput Struct
   // 42:97-116, 1992), and how far penalties may go before round-off matters.
   constexpr real_t slow = 0.25;
   constexpr real_t raise = 10.0;
   constexpr real_t most = 1e4;
   const Violations now = WorstViolations();
   const real_t jump_tolerance = options.pressure_tolerance * peak_pressure;
   bool raised = false;
   const auto check =
      [&](real_t value, real_t tolerance, real_t &last, real_t &factor)
   {
      if (value > tolerance && value > slow * last && factor < most)
      {
         factor *= raise;
         raised = true;
      }
      last = value;
   };
   check(now.penetration, gap_tolerance, last_penetration, stiffening.gap);
   check(now.pressure_jump, jump_tolerance, last_jump, stiffening.jump);
   if (raised)
   {
      SetPenalties();
   }
   return raised;
}

void ContactPair::Store(real_t time)
{
   TakeMultipliers();
   stored.time = {stored.time[1], time};
   stored.multiplier[0] = stored.multiplier[1];
   stored.multiplier[1] = multiplier;
   stored.flux_multiplier[0] = stored.flux_multiplier[1];
   stored.flux_multiplier[1] = flux_multiplier;
}

void ContactPair::Predict(real_t time)
{
   // Beyond one and a half times the last interval a line says little.
   constexpr real_t farthest = 1.5;
   const real_t interval = stored.time[1] - stored.time[0];
   const real_t ahead = time - stored.time[1];
   const real_t s =
      interval > 0.0 && ahead <= farthest * interval ? ahead / interval : 0.0;
   add(1.0 + s, stored.multiplier[1], -s, stored.multiplier[0], multiplier);
   add(1.0 + s, stored.flux_multiplier[1], -s, stored.flux_multiplier[0],
       flux_multiplier);
   for (int j = 0; j < multiplier.Size(); j++)
   {
      multiplier[j] = std::min(multiplier[j], 0.0);
   }
}

void ContactPair::ForgetPast()
{
   stored.time[0] = stored.time[1];
}

std::array<Vector *, 10> ContactPair::WorkingVectors()
{
   return {
      &multiplier, &flux_multiplier, &gap,     &jump,        &traction,
      &flux,       &active,          &sealing, &gap_weights, &jump_weights};
}

void ContactPair::Accept()
{
   accepted = stored;
   accepted_stiffening = stiffening;
   const std::array<Vector *, 10> working = WorkingVectors();
   for (std::size_t i = 0; i < working.size(); i++)
   {
      accepted_vectors[i] = *working[i];
   }
   touched = touched || (traction.Size() > 0 && traction.Min() < 0.0);
}

bool ContactPair::HasTouched() const
{
   return AnyRank(touched, comm);
}

void ContactPair::Restore()
{
   stored = accepted;
   stiffening = accepted_stiffening;
   const std::array<Vector *, 10> working = WorkingVectors();
   for (std::size_t i = 0; i < working.size(); i++)
   {
      *working[i] = accepted_vectors[i];
   }
}

void ContactPair::Archive(StateArchive &archive)
{
   ParFiniteElementSpace &space = source.Spaces().Multiplier();
   const char *times[2] = {"before_last", "last"};
   for (int i = 0; i < 2; i++)
   {
      const std::string prefix = "contact." + name + "." + times[i] + ".";
      archive.Number(prefix + "time", accepted.time[i]);
      archive.Field(prefix + "traction", space, accepted.multiplier[i]);
      archive.Field(prefix + "flux", space, accepted.flux_multiplier[i]);
   }
   const char *names[10] = {"multiplier",  "flux_multiplier", "gap",
                            "jump",        "traction",        "flux",
                            "active",      "sealing",         "gap_weights",
                            "jump_weights"};
   for (std::size_t i = 0; i < accepted_vectors.size(); i++)
   {
      archive.Field("contact." + name + "." + names[i], space,
                    accepted_vectors[i]);
   }
   archive.Number("contact." + name + ".gap_stiffening",
                  accepted_stiffening.gap);
   archive.Number("contact." + name + ".jump_stiffening",
                  accepted_stiffening.jump);
   archive.Flag("contact." + name + ".reached", reached);
   touched = HasTouched();
   archive.Flag("contact." + name + ".touched", touched);
   archive.Field("contact." + name + ".removed_overlap", space,
                 removed_overlap);
   if (archive.Reads())
   {
      Restore();
   }
}

} // namespace synovia
