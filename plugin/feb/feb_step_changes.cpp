#include "synovia/feb/feb_conditions.hpp"
#include "synovia/feb/feb_rigid_steps.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

namespace
{
// In groups of steps, or before version 3.0 one after the other.
std::vector<FebInput> StepsOf(const FebInput &root)
{
   std::vector<FebInput> steps;
   for (const FebInput &group : root.All("Step"))
   {
      const std::vector<FebInput> inner = group.All("step");
      if (inner.empty())
      {
         steps.push_back(group);
      }
      for (const FebInput &step : inner)
      {
         steps.push_back(step);
      }
   }
   return steps;
}

void DelayBoundary(real_t delay, BoundaryCase &boundary)
{
   const auto shift = [delay](std::optional<LoadCurve> &curve)
   {
      if (curve)
      {
         curve = curve->Delayed(delay);
      }
   };
   for (std::optional<LoadCurve> &curve : boundary.displacement)
   {
      shift(curve);
   }
   for (std::optional<LoadCurve> *curve :
        {&boundary.pressure, &boundary.normal_traction,
         &boundary.effective_traction, &boundary.normal_flux,
         &boundary.mixture_flux})
   {
      shift(*curve);
   }
   if (boundary.traction)
   {
      for (LoadCurve &curve : *boundary.traction)
      {
         curve = curve.Delayed(delay);
      }
   }
}

// What stays after the first so many entries becomes the step's.
template <typename Entry>
void Move(size_t first, std::vector<Entry> &from, std::vector<Entry> &to)
{
   const auto begin = from.begin() + static_cast<long>(first);
   to.assign(begin, from.end());
   from.erase(begin, from.end());
}

// By the names of rigid bodies.
std::map<std::string, std::vector<std::string>>
TiedSurfaces(const FebModel &model)
{
   std::map<std::string, std::vector<std::string>> surfaces;
   for (const RigidBodyCase &body : model.setup.rigid_bodies)
   {
      surfaces[body.name] = body.surfaces;
   }
   return surfaces;
}

bool HasRigidSteps(const FebInput &root)
{
   const std::vector<FebInput> steps = StepsOf(root);
   return std::any_of(steps.begin(), steps.end(),
                      [](const FebInput &step)
                      {
                         const std::optional<FebInput> boundary =
                            step.Find("Boundary");
                         return step.Find("Rigid") ||
                                (boundary && boundary->Find("rigid_body"));
                      });
}

StepCase ReadStep(const FebInput &input, size_t number, real_t begin,
                  FebModel &model)
{
   StepCase step;
   step.name = PlainName(input.Attribute("name"));
   if (step.name.empty() || step.name == "_")
   {
      step.name = "step " + std::to_string(number);
   }
   input.Attribute("id");
   const size_t boundaries = model.setup.boundaries.size();
   const size_t contacts = model.setup.contacts.size();
   const size_t ties = model.setup.ties.size();
   const std::map<std::string, std::vector<std::string>> held =
      TiedSurfaces(model);
   model.in_step = true;
   model.first_condition = boundaries;
   using Section = void (*)(const FebInput &, FebModel &);
   const std::pair<const char *, Section> sections[] = {
      {"Boundary", ReadBoundary},
      {"Loads", ReadLoads},
      {"Constraints", ReadConstraints},
      {"Contact", ReadContact}};
   for (const auto &[name, read] : sections)
   {
      if (const std::optional<FebInput> section = input.Find(name))
      {
         read(*section, model);
      }
   }
   PutZerosFirst(model);
   model.in_step = false;
   if (std::any_of(held.begin(), held.end(),
                   [&](const auto &entry) {
                      return entry.second != TiedSurfaces(model)[entry.first];
                   }))
   {
      input.Stop(
         "nodes are only known to be tied to rigid bodies in all steps");
   }
   if (model.setup.ties.size() > ties && number > 1)
   {
      input.Find("Contact")->Stop("surfaces are only known to be tied from the "
                                  "first step on");
   }
   Move(boundaries, model.setup.boundaries, step.boundaries);
   Move(contacts, model.setup.contacts, step.contacts);
   for (size_t i = 0; i < step.boundaries.size(); i++)
   {
      BoundaryCase &boundary = step.boundaries[i];
      boundary.name =
         "step " + std::to_string(number) + " " + std::to_string(i + 1);
      DelayBoundary(-begin, boundary);
   }
   return step;
}
} // namespace

void ReadStepTimes(const FebInput &root, FebModel &model)
{
   std::vector<real_t> ends;
   for (const FebInput &input : StepsOf(root))
   {
      const std::optional<FebInput> control = input.Find("Control");
      if (!control)
      {
         input.Stop("the section Control is missing");
         continue;
      }
      const FebSteps steps = ReadControl(*control, model.module, model.curves,
                                         ends.empty() ? 0.0 : ends.back());
      if (steps.steady)
      {
         control->Stop("steady states are only known without steps");
      }
      StepCase step;
      step.duration = steps.ends.back() - (ends.empty() ? 0.0 : ends.back());
      model.setup.steps.push_back(step);
      ends.insert(ends.end(), steps.ends.begin(), steps.ends.end());
      model.steps.fields_every = steps.fields_every;
   }
   if (!ends.empty())
   {
      model.steps.ends = ends;
      model.steps.length = 0.0;
   }
}

void ReadStepChanges(const FebInput &root, FebModel &model)
{
   real_t begin = 0.0;
   std::vector<std::string> release;
   size_t number = 0;
   const size_t ties = model.setup.ties.size();
   FebRigidSteps rigid(model);
   const bool has_rigid_steps = HasRigidSteps(root);
   for (const FebInput &input : StepsOf(root))
   {
      if (number == model.setup.steps.size())
      {
         return; // after an error
      }
      StepCase step = ReadStep(input, number + 1, begin, model);
      StepCase &entry = model.setup.steps[number++];
      step.duration = entry.duration;
      if (has_rigid_steps)
      {
         step.rigid_bodies =
            rigid.Next(input, begin, begin + entry.duration, model);
      }
      step.release = release;
      entry = step;
      release.clear();
      for (const BoundaryCase &boundary : entry.boundaries)
      {
         release.push_back(boundary.name);
      }
      for (const ContactCase &contact : entry.contacts)
      {
         release.push_back(contact.Name());
      }
      for (size_t i = ties; number == 1 && i < model.setup.ties.size(); i++)
      {
         release.push_back(model.setup.ties[i].Name());
      }
      begin += entry.duration;
   }
}

} // namespace synovia
