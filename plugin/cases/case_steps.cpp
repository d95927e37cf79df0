#include "synovia/cases/case_steps.hpp"
#include "synovia/cases/conditions_in_force.hpp"
#include "synovia/cases/key_names.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
void Delay(real_t delay, std::optional<LoadCurve> &curve)
{
   if (curve)
   {
      curve = curve->Delayed(delay);
   }
}

template <typename Curve>
void Delay(real_t delay, std::array<Curve, 3> &curves);

void Delay(real_t delay, LoadCurve &curve)
{
   curve = curve.Delayed(delay);
}

void Delay(real_t delay, std::optional<std::array<LoadCurve, 3>> &curves)
{
   if (curves)
   {
      Delay(delay, *curves);
   }
}

template <typename Curve>
void Delay(real_t delay, std::array<Curve, 3> &curves)
{
   for (Curve &curve : curves)
   {
      Delay(delay, curve);
   }
}

BoundaryCase Begun(BoundaryCase boundary, real_t begin)
{
   boundary.begin = begin;
   Delay(begin, boundary.displacement);
   Delay(begin, boundary.pressure);
   Delay(begin, boundary.traction);
   Delay(begin, boundary.normal_traction);
   Delay(begin, boundary.effective_traction);
   Delay(begin, boundary.normal_flux);
   Delay(begin, boundary.mixture_flux);
   Delay(begin, boundary.force.curve);
   return boundary;
}

RigidBodyCase Begun(RigidBodyCase body, real_t begin)
{
   body.begin = begin;
   Delay(begin, body.translation);
   Delay(begin, body.rotation);
   Delay(begin, body.force);
   Delay(begin, body.moment);
   return body;
}

/// Lets the steps of a case follow each other.
class Succession
{
public:
   Succession(const CaseFile &setup_, CaseReading &reading_)
      : setup(setup_), reading(reading_),
        boundaries("boundary", setup.boundaries),
        rigid_bodies("rigid_body", setup.rigid_bodies),
        ligaments("ligament", setup.ligaments),
        contacts("contact", setup.contacts), ties("tie", setup.ties),
        standard(setup)
   {
      standard.steps.clear();
      for (LineCase &line : standard.output.lines)
      {
         if (line.times.empty())
         {
            line.times = {setup.time.end};
         }
      }
   }

   CaseOfStep Next(const StepCase &step, const std::string &path)
   {
      Release(step, path);
      for (size_t i = 0; i < step.boundaries.size(); i++)
      {
         Prescribe(step.boundaries[i], EntryPath(path + ".boundary", i));
      }
      for (size_t i = 0; i < step.rigid_bodies.size(); i++)
      {
         Prescribe(step.rigid_bodies[i], EntryPath(path + ".rigid_body", i));
      }
      for (size_t i = 0; i < step.contacts.size(); i++)
      {
         contacts.Set(step.contacts[i], EntryPath(path + ".contact", i));
      }
      const real_t end = begin + step.duration;
      CaseOfStep next{step.name, begin, end, standard};
      Fill(step, next.setup);
      begin = end;
      return next;
   }

private:
   void Release(const StepCase &step, const std::string &path)
   {
      for (size_t i = 0; i < step.release.size(); i++)
      {
         const std::string &name = step.release[i];
         const std::string here = EntryPath(path + ".release", i);
         const bool body = rigid_bodies.Find(name) != nullptr;
         std::vector<std::string> known = boundaries.Names();
         for (const std::vector<std::string> &more :
              {ligaments.Names(), contacts.Names(), ties.Names()})
         {
            known.insert(known.end(), more.begin(), more.end());
         }
         const auto count = std::count(known.begin(), known.end(), name);
         reading.Require(count > 0 || !body, here,
                         Quoted(name) +
                            " is a rigid body, which is never released; give "
                            "its freedoms anew in [[step.rigid_body]]");
         reading.Require(count > 0, here,
                         "no boundary, ligament, contact pair or tie that "
                         "holds is called " +
                            Quoted(name) + DidYouMean(name, known));
         reading.Require(count < 2, here,
                         "several of boundaries, ligaments, contact pairs and "
                         "ties are called " +
                            Quoted(name) + "; rename all but one of them");
         boundaries.Remove(name);
         ligaments.Remove(name);
         contacts.Remove(name);
         ties.Remove(name);
      }
   }

   void Prescribe(const BoundaryCase &given, const std::string &path)
   {
      BoundaryCase boundary = Begun(given, begin);
      if (boundary.surfaces.empty())
      {
         const BoundaryCase *before = boundaries.Find(given.name);
         reading.Require(
            before || reading.HasError(path + ".surfaces"), path + ".surfaces",
            "this is missing, as no boundary that holds is "
            "called " +
               Quoted(given.name) + DidYouMean(given.name, boundaries.Names()));
         boundary.surfaces =
            before ? before->surfaces : std::vector<std::string>{};
      }
      boundaries.Set(boundary, path);
   }

   void Prescribe(const RigidBodyCase &given, const std::string &path)
   {
      const RigidBodyCase *before = rigid_bodies.Find(given.name);
      if (!before)
      {
         reading.Require(false, path + ".name",
                         "there is no rigid body " + Quoted(given.name) +
                            DidYouMean(given.name, rigid_bodies.Names()));
         return;
      }
      RigidBodyCase body = Begun(given, begin);
      body.surfaces = before->surfaces;
      body.regions = before->regions;
      body.shape = before->shape;
      body.reference = before->reference;
      rigid_bodies.Set(body, path);
   }

   void Fill(const StepCase &step, CaseFile &filled) const
   {
      filled.boundaries = boundaries.Entries();
      filled.rigid_bodies = rigid_bodies.Entries();
      filled.ligaments = ligaments.Entries();
      filled.contacts = contacts.Entries();
      filled.ties = ties.Entries();
      for (const char *list :
           {"boundary", "rigid_body", "ligament", "contact", "tie", "step"})
      {
         const std::string above = std::string(list) + ".";
         const std::string below = std::string(list) + "/";
         filled.places.erase(filled.places.lower_bound(above),
                             filled.places.lower_bound(below));
      }
      boundaries.AddPlaces(setup.places, filled.places);
      rigid_bodies.AddPlaces(setup.places, filled.places);
      ligaments.AddPlaces(setup.places, filled.places);
      contacts.AddPlaces(setup.places, filled.places);
      ties.AddPlaces(setup.places, filled.places);
      TimeOptions &time = filled.time;
      time.adaptive = step.adaptive.value_or(time.adaptive);
      if (step.step > 0.0)
      {
         time.step = step.step;
         time.min_step = 0.0;
      }
      if (step.growth != 0.0)
      {
         time.growth = step.growth;
      }
      else if (time.adaptive)
      {
         time.growth = 1.0;
      }
      if (step.min_step > 0.0)
      {
         time.min_step = step.min_step;
      }
      time.max_step = step.max_step > 0.0
                         ? step.max_step
                         : std::max(time.step, real_t(0.1) * step.duration);
   }

   const CaseFile &setup;
   CaseReading &reading;
   ConditionsInForce<BoundaryCase> boundaries;
   ConditionsInForce<RigidBodyCase> rigid_bodies;
   ConditionsInForce<Ligament> ligaments;
   ConditionsInForce<ContactCase> contacts;
   ConditionsInForce<TieCase> ties;
   CaseFile standard;
   real_t begin = 0.0;
};

std::string Named(const std::string &name,
                  const std::vector<std::string> &surfaces)
{
   return name.empty() ? JoinedNames(surfaces) : name;
}
} // namespace

std::vector<CaseOfStep> CasesOfSteps(const CaseFile &setup,
                                     CaseReading &reading)
{
   if (setup.steps.empty())
   {
      return {{"", 0.0, setup.time.end, setup}};
   }
   Succession succession(setup, reading);
   std::vector<CaseOfStep> cases;
   for (size_t i = 0; i < setup.steps.size(); i++)
   {
      cases.push_back(succession.Next(setup.steps[i], EntryPath("step", i)));
   }
   return cases;
}

std::vector<CaseOfStep> CasesOfSteps(const CaseFile &setup)
{
   CaseReading reading(setup.places);
   std::vector<CaseOfStep> cases = CasesOfSteps(setup, reading);
   reading.ThrowIfAny();
   return cases;
}

real_t EndOfSteps(const std::vector<StepCase> &steps)
{
   real_t end = 0.0;
   for (const StepCase &step : steps)
   {
      end += step.duration;
   }
   return end;
}

std::string ChangesText(const StepCase &step)
{
   std::string text;
   const auto add = [&](const std::string &what)
   { text += (text.empty() ? "" : ", ") + what; };
   for (const std::string &name : step.release)
   {
      add("without " + name);
   }
   for (const BoundaryCase &boundary : step.boundaries)
   {
      add(Named(boundary.name, boundary.surfaces));
   }
   for (const RigidBodyCase &body : step.rigid_bodies)
   {
      add(body.name);
   }
   for (const ContactCase &contact : step.contacts)
   {
      add(contact.Name());
   }
   return text.empty() ? "-" : text;
}

} // namespace synovia
