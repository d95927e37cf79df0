#include "synovia/feb/feb_law_words.hpp"
#include "synovia/feb/feb_laws.hpp"
#include "synovia/materials/law_registry.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
// Of a frame.
const char *const axis_names[3] = {"r", "theta", "z"};

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
} // namespace

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

PermeabilityCase ReadOrthotropic(const FebInput &from, FebFrame &frame)
{
   PermeabilityCase result;
   result.model = "referential_orthotropic";
   const std::array<int, 3> places = frame.Places(from);
   std::array<std::string, 3> frame_axes;
   for (int a = 0; a < 3; a++)
   {
      frame_axes[a] = axis_names[places[a]];
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

namespace
{
// The law is along theta of the frame.
void VerifyAxis(const FebInput &permeability, FebFrame &frame)
{
   constexpr real_t same_direction = 1e-12;
   const Point3 first = frame.Components(permeability, FebDirection());
   if (std::abs(std::abs(first[1]) - 1.0) > same_direction)
   {
      permeability.Stop("the first material axis must be around the cylinder");
   }
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

PermeabilityCase ReadPermeability(const FebInput &permeability, FebFrame &frame)
{
   PermeabilityCase result;
   if (permeability.Attribute("type") == orthotropic)
   {
      return ReadOrthotropic(permeability, frame);
   }
   if (const LawWords *words =
          FindLaw(permeability, PermeabilityWords(), "perm-ref-ortho"))
   {
      result.model = words->law;
      result.parameters = ReadParameters(permeability, *words,
                                         *PermeabilityLaws().Find(words->law));
      if (words->feb == "perm-ref-trans-iso")
      {
         VerifyAxis(permeability, frame);
      }
   }
   return result;
}

} // namespace synovia
