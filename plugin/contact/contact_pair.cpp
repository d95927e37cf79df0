#include "synovia/contact/contact_pair.hpp"
#include "synovia/contact/contact_friction.hpp"
#include "synovia/contact/finite_constraint.hpp"
#include "synovia/contact/infinitesimal_constraint.hpp"
#include "synovia/general/error.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
const ContactOptions &Verified(const ContactOptions &options,
                               const std::string &pair)
{
   Verify(options, pair);
   return options;
}

std::unique_ptr<ContactConstraint> MakeConstraint(ContactGeometry &geometry,
                                                  const ContactOptions &options,
                                                  Deformation deformation,
                                                  real_t gap_tolerance,
                                                  const ContactTuning &tuning)
{
   if (deformation == Deformation::finite)
   {
      // Forces of friction follow areas that lag behind by as much.
      ContactTuning of_pair(tuning);
      of_pair.kept_slide =
         options.friction.coefficient > 0.0 ? 0.0 : tuning.kept_slide;
      return std::make_unique<FiniteConstraint>(
         geometry, options.initial_overlap, gap_tolerance, of_pair);
   }
   return std::make_unique<InfinitesimalConstraint>(
      geometry, options.configuration, options.initial_overlap,
      tuning.kept_slide);
}

std::unique_ptr<ContactFriction> MakeFriction(const std::string &pair,
                                              ContactConstraint &constraint,
                                              const ContactSurface &destination,
                                              const ContactOptions &options,
                                              const ContactScales &scales)
{
   FiniteConstraint *finite = dynamic_cast<FiniteConstraint *>(&constraint);
   if (!finite)
   {
      throw Error("contact pair \"" + pair +
                  "\": there is friction in finite deformation only; set "
                  "physics.deformation = \"finite\", or leave friction out");
   }
   if (scales.fluid == FluidSides::source)
   {
      throw Error("contact pair \"" + pair +
                  "\": friction counts the fluid pressure of the destination, "
                  "and only the source has fluid; swap the two");
   }
   return std::make_unique<ContactFriction>(
      *finite, destination,
      FrictionLaw(options.friction.coefficient, scales.solid_fraction));
}
} // namespace

ContactPair::ContactPair(const std::string &name_, BiphasicSpaces &spaces,
                         const MaterialTable &materials,
                         const Array<int> &source_boundary,
                         const Array<int> &destination_boundary,
                         const ContactOptions &options, Deformation deformation,
                         const ContactTuning &tuning)
   : name(name_), source_sealing_coverage(tuning.source_sealing_coverage),
     scales(FindContactScales(name, spaces.GetMesh(), materials,
                              source_boundary, destination_boundary,
                              Verified(options, name))),
     drains(scales.fluid != FluidSides::both &&
            options.dry_partner == DryPartner::draining),
     geometry(name, spaces, source_boundary, destination_boundary, scales,
              options, tuning),
     constraint(MakeConstraint(geometry, options, deformation,
                               scales.gap_tolerance, tuning)),
     enforcement(*constraint, geometry.Destination(),
                 geometry.DestinationAreas(), scales, options, tuning)
{
   if (deformation == Deformation::finite &&
       options.normal != ContactNormal::destination)
   {
      throw Error("contact pair \"" + name +
                  "\": in finite deformation gaps are along the normal of the "
                  "destination; leave normal out");
   }
   if (options.friction.coefficient > 0.0)
   {
      enforcement.AddFriction(MakeFriction(
         name, *constraint, geometry.Destination(), options, scales));
   }
}

bool ContactPair::Search(const Vector &u)
{
   ContactFriction *friction = enforcement.Friction();
   if (friction)
   {
      friction->FindOrigin();
      friction->ForgetDerivatives();
   }
   const bool found_anew = constraint->Search(u);
   if (found_anew)
   {
      enforcement.UpdatePenalties();
   }
   return found_anew;
}

void ContactPair::StartLinearize(const Vector &p)
{
   Vector nodal_force(constraint->Coverage().area);
   Vector nodal_flow(nodal_force);
   nodal_force *= State().traction;
   nodal_flow *= State().flux;
   constraint->StartLinearize(p, nodal_force, nodal_flow);
}

bool ContactPair::FinishLinearize(const Vector &p)
{
   const bool changed = constraint->FinishLinearize();
   if (ContactFriction *friction = enforcement.Friction())
   {
      friction->Linearize(p, constraint->Factors(), constraint->Coverage().area,
                          enforcement.Penalties().Gap(),
                          enforcement.Penalties().AreaResistance(), State());
   }
   return changed;
}

void ContactPair::MarkSealed(Vector &sealed) const
{
   if (drains)
   {
      return;
   }
   const Vector sealing = State().Sealing();
   const Array<int> &destination_dofs =
      geometry.Destination().Vertices().TrueDofs();
   for (int j = 0; j < sealing.Size(); j++)
   {
      if (sealing[j] > 0.5)
      {
         sealed[destination_dofs[j]] = 1.0;
      }
   }
   const Vector &areas = geometry.SourceAreas();
   const Array<int> &source_dofs = geometry.Source().Vertices().TrueDofs();
   Vector covered(areas.Size());
   constraint->Coverage().coverage->Mult(sealing, covered);
   covered.HostRead();
   for (int k = 0; k < covered.Size(); k++)
   {
      if (covered[k] > 0.0 && covered[k] > source_sealing_coverage * areas[k])
      {
         sealed[source_dofs[k]] = 1.0;
      }
   }
}

void ContactPair::AddForces(Vector &momentum, Vector &mass) const
{
   Vector nodal_force(constraint->Coverage().area);
   Vector nodal_flux(constraint->Coverage().area);
   nodal_force *= State().traction;
   nodal_flux *= State().flux;
   const ContactFactors factors = constraint->Factors();
   Vector force(momentum.Size());
   Vector outflow(mass.Size());
   factors.gap->MultTranspose(nodal_force, force);
   factors.jump->MultTranspose(nodal_flux, outflow);
   momentum -= force;
   mass += outflow;
   if (const ContactFriction *friction = enforcement.Friction())
   {
      friction->AddForces(State().friction, constraint->Coverage().area,
                          momentum);
   }
}

MultiplierStep ContactPair::FindMultiplierStep(const Vector &du,
                                               const Vector &dp,
                                               const Vector &forces,
                                               const Vector &outflows) const
{
   const ContactFactors factors = constraint->Factors();
   Vector gap_change(factors.gap->Height());
   Vector jump_change(factors.jump->Height());
   factors.gap_change->Mult(du, gap_change);
   factors.jump->Mult(dp, jump_change);
   if (factors.jump_change)
   {
      factors.jump_change->Mult(1.0, du, 1.0, jump_change);
   }
   gap_change.HostRead();
   jump_change.HostRead();
   MultiplierStep step =
      enforcement.FindMultiplierStep(gap_change, jump_change);
   if (forces.Size() > 0)
   {
      enforcement.AddSolved(forces, outflows, step);
   }
   step.friction = enforcement.FindFrictionStep(du, dp);
   return step;
}

void ContactPair::AddMagnitudes(const Vector &u, const Vector &p,
                                Vector &momentum, Vector &mass) const
{
   const ContactFactors factors = Factors();
   Vector rows(factors.gap->Height());
   factors.gap_change->AbsMult(1.0, u, 0.0, rows);
   rows *= *factors.gap_weights;
   factors.gap->AbsMultTranspose(1.0, rows, 1.0, momentum);
   factors.jump->AbsMult(1.0, p, 0.0, rows);
   rows *= *factors.jump_weights;
   factors.jump->AbsMultTranspose(1.0, rows, 1.0, mass);
}

ContactFactors ContactPair::Factors() const
{
   ContactFactors factors = constraint->Factors();
   factors.gap_weights = &State().gap_weights;
   factors.jump_weights = &State().jump_weights;
   factors.gap_resistance = &enforcement.Penalties().AreaResistance();
   const ContactFriction *friction = enforcement.Friction();
   if (!friction)
   {
      factors.gap_values = &State().gap;
      factors.jump_values = &State().jump;
   }
   if (friction && friction->ForceChange())
   {
      factors.force_change = friction->ForceChange();
      factors.soft_force_change = friction->SoftForceChange();
      factors.force_by_pressure = friction->ForceByPressure();
   }
   return factors;
}

void ContactPair::Archive(StateArchive &archive)
{
   const std::string prefix = "contact." + name + ".";
   enforcement.Archive(archive, prefix);
   constraint->Archive(archive, prefix);
}

} // namespace synovia
