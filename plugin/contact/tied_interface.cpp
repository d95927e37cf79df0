#include "synovia/contact/tied_interface.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/general/reduce_lists.hpp"
#include "synovia/general/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr real_t forever = std::numeric_limits<real_t>::infinity();

// Times what the bodies resist. Nothing comes loose, so that penalties may be
// larger than those of contact: each augmentation leaves a tenth to a
// thousandth of a jump.
constexpr real_t penalty_factor = 1e3;

// Of the modulus: pressures below are round-off, such as those that are left
// when all fluid has come to rest.
constexpr real_t no_pressure = 1e-14;

GapOptions SearchOptions(const TieScales &scales, int order,
                         const ContactTuning &tuning)
{
   GapOptions options;
   options.search_radius = scales.search_radius;
   // Displacement times multiplier, in both directions of a quadrilateral.
   options.quadrature_order = std::max(5, 2 * order + 2);
   options.rim_coverage = tuning.rim_coverage;
   return options;
}
} // namespace

TiedInterface::TiedInterface(const std::string &name_, BiphasicSpaces &spaces_,
                             const MaterialTable &materials,
                             const Array<int> &source_boundary,
                             const Array<int> &destination_boundary,
                             const TieOptions &options,
                             const ContactTuning &tuning_)
   : name(name_), spaces(spaces_),
     scales(FindTieScales(name, spaces.GetMesh(), materials, source_boundary,
                          destination_boundary, options)),
     tuning(tuning_), pressure_tolerance(options.pressure_tolerance),
     source(spaces, source_boundary), destination(spaces, destination_boundary),
     destination_areas(NodalAreas(destination)), time_step(forever),
     state(destination_areas.Size()), accepted(state)
{
   int shared = 0;
   for (const int dof : source.Vertices().TrueDofs())
   {
      shared += destination.Vertices().TrueDofs().FindSorted(dof) >= 0;
   }
   if (AnyRank(shared > 0, spaces.GetComm()))
   {
      throw Error("tie \"" + name +
                  "\": source and destination share vertices; bodies that have "
                  "common nodes move together without a tie");
   }
   for (Vector *values :
        {&resistance, &conductance, &penalty, &pressure_penalty,
         &pressure_weights, &no_weights, &weights[0], &weights[1], &weights[2],
         &resistance_weights[0], &resistance_weights[1],
         &resistance_weights[2]})
   {
      values->SetSize(destination_areas.Size());
      *values = 0.0;
   }
}

void TiedInterface::Search(const TieHolds &holds)
{
   operators = AssembleTieOperators(
      source, destination, destination_areas,
      SearchOptions(scales, spaces.Order(), tuning), holds, scales.exchanges);
   if (!(operators.covered > 0.0))
   {
      throw Error("tie \"" + name +
                  "\": looking along the normals of the destination, no point "
                  "of the source is within the search radius of " +
                  ToText(scales.search_radius) +
                  "; check the names of the surfaces, or give a larger "
                  "search_radius");
   }
   UpdatePenalties();
}

void TiedInterface::UpdatePenalties()
{
   const real_t modulus = scales.softest_modulus;
   for (int j = 0; j < resistance.Size(); j++)
   {
      const real_t h = operators.face_size[j];
      resistance[j] = h > 0.0 ? modulus / h : 0.0;
      conductance[j] =
         scales.exchanges && h > 0.0
            ? scales.least_permeability / h + h / (modulus * time_step)
            : 0.0;
      penalty[j] = state.stiffening.gap * penalty_factor * resistance[j];
      pressure_penalty[j] =
         state.stiffening.jump * penalty_factor * conductance[j];
      for (int c = 0; c < 3; c++)
      {
         weights[c][j] = operators.area[c][j] * penalty[j];
         resistance_weights[c][j] = operators.area[c][j] * resistance[j];
      }
      pressure_weights[j] = operators.pressure_area[j] * pressure_penalty[j];
   }
}

void TiedInterface::SetTimeStep(real_t dt)
{
   // Steps that end on a corner differ by round-off.
   if (!(std::abs(dt - time_step) <= 1e-6 * dt))
   {
      time_step = dt;
      UpdatePenalties();
   }
}

void TiedInterface::StartStage(real_t time)
{
   last = {forever, forever};
   state.Predict(time, tuning.prediction_reach);
}

void TiedInterface::Evaluate(const Vector &u, const Vector &p)
{
   for (int c = 0; c < 3; c++)
   {
      operators.jump[c]->Mult(u, state.jump[c]);
      state.jump[c].HostReadWrite();
   }
   operators.pressure_jump->Mult(p, state.pressure_jump);
   state.pressure_jump.HostReadWrite();
}

void TiedInterface::UpdateTractions(ContactStiffness stiffness)
{
   const bool none = stiffness == ContactStiffness::none;
   const bool soft = stiffness == ContactStiffness::bodies;
   const Vector &eta = soft ? resistance : penalty;
   const Vector &eta_p = soft ? conductance : pressure_penalty;
   state.acting = state.multiplier;
   for (int j = 0; j < eta.Size() && !none; j++)
   {
      for (int c = 0; c < 3; c++)
      {
         state.acting.traction[c][j] += eta[j] * state.jump[c][j];
      }
      state.acting.flux[j] += eta_p[j] * state.pressure_jump[j];
   }
}

TieMultipliers TiedInterface::FindMultiplierStep(const Vector &du,
                                                 const Vector &dp) const
{
   TieMultipliers step(penalty.Size());
   for (int c = 0; c < 3; c++)
   {
      operators.jump[c]->Mult(du, step.traction[c]);
      step.traction[c].HostReadWrite();
      step.traction[c] += state.jump[c];
      step.traction[c] *= penalty;
   }
   operators.pressure_jump->Mult(dp, step.flux);
   step.flux.HostReadWrite();
   step.flux += state.pressure_jump;
   step.flux *= pressure_penalty;
   return step;
}

TieViolations TiedInterface::FindViolations() const
{
   std::vector<real_t> worst(2, 0.0);
   for (const Vector &component : state.jump)
   {
      if (component.Size() > 0)
      {
         worst[0] = std::max(worst[0], component.Normlinf());
         worst[1] = std::max(worst[1], state.pressure_jump.Normlinf());
      }
   }
   MaxOverRanks(worst, spaces.GetComm());
   return {worst[0], worst[1]};
}

real_t TiedInterface::PressureTolerance(real_t peak_pressure) const
{
   return std::max(pressure_tolerance * peak_pressure,
                   no_pressure * scales.softest_modulus);
}

bool TiedInterface::IsWithinTolerance(const TieViolations &violations,
                                      real_t peak_pressure) const
{
   return violations.displacement <= scales.displacement_tolerance &&
          violations.pressure <= PressureTolerance(peak_pressure);
}

bool TiedInterface::StiffenIfSlow(const TieViolations &violations,
                                  real_t peak_pressure)
{
   bool raised = false;
   const auto check =
      [&](real_t value, real_t tolerance, real_t &last_value, real_t &factor)
   {
      if (value > tolerance && value > tuning.slow_augmentation * last_value &&
          factor < tuning.largest_stiffening)
      {
         factor *= tuning.stiffening_factor;
         raised = true;
      }
      last_value = value;
   };
   check(violations.displacement, scales.displacement_tolerance,
         last.displacement, state.stiffening.gap);
   check(violations.pressure, PressureTolerance(peak_pressure), last.pressure,
         state.stiffening.jump);
   if (raised)
   {
      UpdatePenalties();
   }
   return raised;
}

void TiedInterface::Restore()
{
   state = accepted;
   UpdatePenalties();
}

void TiedInterface::Archive(StateArchive &archive)
{
   accepted.Archive(archive, "tie." + name + ".", destination);
   if (archive.Reads())
   {
      Restore();
   }
}

void TiedInterface::AddForces(Vector &momentum, Vector &mass) const
{
   Vector nodal(penalty.Size());
   Vector force(momentum.Size());
   for (int c = 0; c < 3; c++)
   {
      nodal = operators.area[c];
      nodal *= state.acting.traction[c];
      operators.jump[c]->MultTranspose(nodal, force);
      momentum -= force;
   }
   nodal = operators.pressure_area;
   nodal *= state.acting.flux;
   Vector outflow(mass.Size());
   operators.pressure_jump->MultTranspose(nodal, outflow);
   mass += outflow;
}

void TiedInterface::AddMagnitudes(const Vector &u, const Vector &p,
                                  Vector &momentum, Vector &mass) const
{
   Vector rows(penalty.Size());
   for (int c = 0; c < 3; c++)
   {
      operators.jump[c]->AbsMult(1.0, u, 0.0, rows);
      rows *= weights[c];
      operators.jump[c]->AbsMultTranspose(1.0, rows, 1.0, momentum);
   }
   operators.pressure_jump->AbsMult(1.0, p, 0.0, rows);
   rows *= pressure_weights;
   operators.pressure_jump->AbsMultTranspose(1.0, rows, 1.0, mass);
}

std::array<ContactFactors, 3> TiedInterface::Factors() const
{
   std::array<ContactFactors, 3> factors;
   for (int c = 0; c < 3; c++)
   {
      const bool has_jump = c == 0 && scales.exchanges;
      factors[c].gap = factors[c].gap_change = operators.jump[c].get();
      factors[c].gap_weights = &weights[c];
      factors[c].gap_resistance = &resistance_weights[c];
      factors[c].jump =
         has_jump ? operators.pressure_jump.get() : operators.no_jump.get();
      factors[c].jump_weights = has_jump ? &pressure_weights : &no_weights;
   }
   return factors;
}

} // namespace synovia
