#include "synovia/feb/feb_laws.hpp"
#include "synovia/materials/law_registry.hpp"
#include "synovia/materials/material_frame.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr real_t same_direction = 1e-12;

/// A law by its names, and its parameters by theirs: FEBio's first.
struct LawWords
{
   std::string feb;
   std::string law;
   std::vector<std::pair<std::string, std::string>> parameters;
};

const std::vector<LawWords> &SolidWords()
{
   static const std::vector<LawWords> words{
      {"neo-Hookean", "neo_hookean", {{"E", "E"}, {"v", "nu"}}},
      {"Holmes-Mow", "holmes_mow", {{"E", "E"}, {"v", "nu"}, {"beta", "beta"}}},
      {"isotropic elastic",
       "saint_venant_kirchhoff",
       {{"E", "E"}, {"v", "nu"}}},
      {"coupled Mooney-Rivlin",
       "mooney_rivlin",
       {{"c1", "c1"}, {"c2", "c2"}, {"k", "k"}}},
      {"porous neo-Hookean", "porous_neo_hookean", {{"E", "E"}}},
      {"fiber-exp-pow",
       "fiber_exp_pow",
       {{"alpha", "alpha"},
        {"beta", "beta"},
        {"ksi", "ksi"},
        {"mu", "mu"},
        {"lam0", "lam0"}}},
      {"fiber-pow-linear",
       "fiber_pow_linear",
       {{"E", "E"}, {"beta", "beta"}, {"lam0", "lam0"}}},
      {"fiber-NH", "fiber_nh", {{"mu", "mu"}}},
      {"fiber-natural-NH",
       "fiber_natural_nh",
       {{"ksi", "ksi"}, {"lam0", "lam0"}}}};
   return words;
}

const std::vector<LawWords> &PermeabilityWords()
{
   static const std::vector<LawWords> words{
      {"perm-const-iso", "constant", {{"perm", "value"}}},
      {"perm-exp-iso", "exponential", {{"perm", "value"}, {"M", "M"}}},
      {"perm-Holmes-Mow",
       "holmes_mow",
       {{"perm", "value"}, {"M", "M"}, {"alpha", "alpha"}}},
      {"perm-ref-iso",
       "referential_isotropic",
       {{"perm0", "k0"},
        {"perm1", "k1"},
        {"perm2", "k2"},
        {"M", "M"},
        {"alpha", "alpha"}}},
      {"perm-ref-trans-iso",
       "referential_transversely_isotropic",
       {{"perm0", "k0"},
        {"perm1T", "k1T"},
        {"perm1A", "k1A"},
        {"perm2T", "k2T"},
        {"perm2A", "k2A"},
        {"M0", "M0"},
        {"MT", "MT"},
        {"MA", "MA"},
        {"alpha0", "alpha0"},
        {"alphaT", "alphaT"},
        {"alphaA", "alphaA"}}}};
   return words;
}

// The law that the attribute type names; null after an error.
const LawWords *FindLaw(const FebInput &from,
                        const std::vector<LawWords> &words,
                        const std::string &also = "")
{
   const std::string type = from.NeededAttribute("type");
   std::string known = also;
   for (const LawWords &law : words)
   {
      if (law.feb == type)
      {
         return &law;
      }
      known += (known.empty() ? "" : ", ") + law.feb;
   }
   from.StopAll("\"" + type + "\" is not known; there are " + known);
   return nullptr;
}

std::map<std::string, real_t> ReadParameters(const FebInput &from,
                                             const LawWords &words,
                                             const LawDescription &law)
{
   std::map<std::string, real_t> values;
   for (const auto &[feb, name] : words.parameters)
   {
      const LawParameter &parameter = *law.Find(name);
      const std::optional<FebInput> found = from.Find(feb);
      if (!found)
      {
         if (!parameter.standard)
         {
            from.Stop("<" + feb + "> is missing");
         }
         continue;
      }
      const std::optional<real_t> value = found->FindNumber();
      if (!value)
      {
         continue;
      }
      try
      {
         parameter.Verify(*value);
         values[name] = *value;
      }
      catch (const Error &error)
      {
         found->Stop(error.what());
      }
   }
   return values;
}

// The vector's components along r, theta and z of the frame.
Point3 InFrame(const Point3 &vector, const FrameCase &frame)
{
   const Tensor3<> axes = AxesAlong(frame.axis);
   Point3 components{};
   for (int i = 0; i < 3; i++)
   {
      for (int j = 0; j < 3; j++)
      {
         components[i] += axes[j][i] * vector[j];
      }
   }
   return components;
}

Point3 Rotated(const Tensor3<> &axes, const Point3 &vector)
{
   Point3 rotated{};
   for (int i = 0; i < 3; i++)
   {
      for (int j = 0; j < 3; j++)
      {
         rotated[i] += axes[i][j] * vector[j];
      }
   }
   return rotated;
}
} // namespace

SolidCase ReadSolid(const FebInput &solid, const Tensor3<> &axes,
                    const FrameCase &frame)
{
   SolidCase result;
   solid.Ignore("density", "inertia is left out");
   if (solid.Attribute("type") == "solid mixture")
   {
      result.model = "mixture";
      for (const FebInput &part : solid.All("solid"))
      {
         result.solids.push_back(ReadSolid(part, axes, frame));
      }
      return result;
   }
   const LawWords *words = FindLaw(solid, SolidWords(), "solid mixture");
   if (!words)
   {
      return result;
   }
   if (words->law == "porous_neo_hookean")
   {
      solid.Ignore("phi0", "that of the biphasic material counts");
   }
   const LawDescription &law = *SolidLaws().Find(words->law);
   result.model = words->law;
   result.parameters = ReadParameters(solid, *words, law);
   if (law.is_fiber)
   {
      result.vectors["direction"] =
         InFrame(Rotated(axes, ReadFiber(solid)), frame);
   }
   return result;
}

namespace
{
const std::string orthotropic = "perm-ref-ortho";

// A child with a number for each of the material's axes, as parameters of a law
// with one for each axis of the frame.
void ReadAlongAxes(const FebInput &from, const std::string &child,
                   const std::string &parameter,
                   const std::array<std::string, 3> &frame_axes,
                   std::map<std::string, real_t> &values)
{
   const std::optional<FebInput> found = from.Find(child);
   const std::vector<real_t> numbers =
      found ? found->Numbers() : std::vector<real_t>{0.0, 0.0, 0.0};
   if (numbers.size() != 3)
   {
      found->Stop("there is one number for each of three axes");
      return;
   }
   for (int a = 0; a < 3; a++)
   {
      values[parameter + "_" + frame_axes[a]] = numbers[a];
   }
}

PermeabilityCase ReadOrthotropic(const FebInput &from, const Tensor3<> &axes,
                                 const FrameCase &frame)
{
   PermeabilityCase result;
   result.model = "referential_orthotropic";
   const char *const names[3] = {"r", "theta", "z"};
   std::array<std::string, 3> frame_axes;
   for (int a = 0; a < 3; a++)
   {
      const Point3 parts = InFrame({axes[0][a], axes[1][a], axes[2][a]}, frame);
      for (int b = 0; b < 3; b++)
      {
         if (std::abs(std::abs(parts[b]) - 1.0) < same_direction)
         {
            frame_axes[a] = names[b];
         }
      }
      if (frame_axes[a].empty())
      {
         from.Stop("the material axes must be along those of space");
         return result;
      }
   }
   std::map<std::string, real_t> &values = result.parameters;
   values["k0"] = from.Number("perm0", 1.0);
   values["M0"] = from.Number("M0", 0.0);
   values["alpha0"] = from.Number("alpha0", 0.0);
   ReadAlongAxes(from, "perm1", "k1", frame_axes, values);
   ReadAlongAxes(from, "perm2", "k2", frame_axes, values);
   ReadAlongAxes(from, "M", "M", frame_axes, values);
   ReadAlongAxes(from, "alpha", "alpha", frame_axes, values);
   return result;
}
} // namespace

void Scale(real_t factor, PermeabilityCase &permeability)
{
   const LawDescription &law = *PermeabilityLaws().Find(permeability.model);
   const std::string unit = ReferencePermeability().unit;
   for (auto &[name, value] : permeability.parameters)
   {
      if (law.Find(name)->unit == unit)
      {
         value *= factor;
      }
   }
}

PermeabilityCase ReadPermeability(const FebInput &permeability,
                                  const Tensor3<> &axes, const FrameCase &frame)
{
   PermeabilityCase result;
   if (permeability.Attribute("type") == orthotropic)
   {
      return ReadOrthotropic(permeability, axes, frame);
   }
   if (const LawWords *words =
          FindLaw(permeability, PermeabilityWords(), "perm-ref-ortho"))
   {
      result.model = words->law;
      result.parameters = ReadParameters(permeability, *words,
                                         *PermeabilityLaws().Find(words->law));
   }
   return result;
}

} // namespace synovia
