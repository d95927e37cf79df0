#include "synovia/feb/feb_rigid_steps.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
std::optional<LoadCurve> &CurveOf(int freedom, RigidBodyCase &body)
{
   return (freedom < 3 ? body.translation : body.rotation)[freedom % 3];
}

LoadCurve Shifted(real_t by, const LoadCurve &curve)
{
   std::vector<real_t> values;
   for (const real_t t : curve.Corners())
   {
      values.push_back(curve(t) + by);
   }
   return LoadCurve(curve.Corners(), values);
}

// Lets all prescribed freedoms count from where the body is, or none of them.
void MakeAlike(const std::array<bool, 6> &relative,
               const std::array<std::optional<real_t>, 6> &places,
               const FebInput &step, RigidBodyCase &body)
{
   bool all_known = true;
   for (int i = 0; i < 6; i++)
   {
      all_known = all_known && (!relative[i] || places[i]);
   }
   body.relative = !all_known;
   for (int i = 0; i < 6; i++)
   {
      std::optional<LoadCurve> &curve = CurveOf(i, body);
      if (!curve || relative[i] == body.relative)
      {
         continue;
      }
      if (!places[i])
      {
         step.Stop("the rigid body \"" + body.name +
                   "\" moves to a place, and from where it happens to be; "
                   "both in one step are not known");
         return;
      }
      curve = Shifted(body.relative ? -*places[i] : *places[i], *curve);
   }
}

void DelayBody(real_t delay, RigidBodyCase &body)
{
   for (int i = 0; i < 6; i++)
   {
      std::optional<LoadCurve> &curve = CurveOf(i, body);
      if (curve)
      {
         curve = curve->Delayed(delay);
      }
   }
   for (auto *loads : {&body.force, &body.moment})
   {
      if (*loads)
      {
         for (LoadCurve &load : **loads)
         {
            load = load.Delayed(delay);
         }
      }
   }
}
} // namespace

FebRigidSteps::FebRigidSteps(const FebModel &model)
   : bodies(model.setup.rigid_bodies), places(bodies.size())
{
   for (Places &place : places)
   {
      place.fill(0.0);
   }
}

std::vector<RigidBodyCase> FebRigidSteps::Next(const FebInput &step,
                                               real_t begin, real_t end,
                                               FebModel &model)
{
   model.in_step = true;
   const size_t ligaments = model.setup.ligaments.size();
   const size_t joints = model.setup.joints.size();
   if (const std::optional<FebInput> section = step.Find("Rigid"))
   {
      ReadRigid(*section, model);
   }
   model.in_step = false;
   if (model.setup.ligaments.size() != ligaments ||
       model.setup.joints.size() != joints)
   {
      step.Find("Rigid")->Stop("rigid bodies are only known to be connected in "
                               "all steps");
   }
   std::vector<RigidBodyCase> moved;
   std::swap(moved, model.setup.rigid_bodies);
   model.setup.rigid_bodies = bodies;
   for (size_t b = 0; b < moved.size(); b++)
   {
      RigidBodyCase &body = moved[b];
      MakeAlike(model.relative[body.name], places[b], step, body);
      for (int i = 0; i < 6; i++)
      {
         const std::optional<LoadCurve> &curve = CurveOf(i, body);
         const real_t before = body.relative ? places[b][i].value_or(0.0) : 0.0;
         const bool known = curve && (!body.relative || places[b][i]);
         places[b][i] = known ? std::optional<real_t>(before + (*curve)(end))
                              : std::nullopt;
      }
      DelayBody(-begin, body);
   }
   model.relative.clear();
   return moved;
}

} // namespace synovia
