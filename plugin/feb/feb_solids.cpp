#include "synovia/feb/feb_law_words.hpp"
#include "synovia/feb/feb_laws.hpp"
#include "synovia/materials/law_registry.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
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
      {"PRLig",
       "prlig",
       {{"c1", "c1"},
        {"c2", "c2"},
        {"mu", "mu"},
        {"v0", "v0"},
        {"m", "m"},
        {"k", "k"}}},
      {"trans iso Mooney-Rivlin",
       "trans_iso_mooney_rivlin",
       {{"c1", "c1"},
        {"c2", "c2"},
        {"c3", "c3"},
        {"c4", "c4"},
        {"c5", "c5"},
        {"lam_max", "lam_max"},
        {"k", "k"}}},
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
} // namespace

namespace
{
FebDirection FirstAxis(const FebAxes &axes)
{
   FebDirection first;
   first.direction = {axes.axes[0][0], axes.axes[1][0], axes.axes[2][0]};
   first.cylinder = axes.cylinder;
   first.at_centers = axes.at_centers;
   if (axes.of_element)
   {
      first.of_element =
         [of_element = axes.of_element](const FebCell &cell, int part)
      {
         const Tensor3<> own = of_element(cell, part);
         return Point3{{own[0][0], own[1][0], own[2][0]}};
      };
   }
   return first;
}

// A child with a number for each of the material's axes, in the order of those
// of the frame.
Point3 ReadAlongFrame(const FebInput &from, const std::string &child,
                      FebFrame &frame)
{
   const std::optional<FebInput> found = from.Find(child);
   const std::vector<real_t> numbers =
      found ? found->Numbers() : std::vector<real_t>();
   Point3 ordered{{1.0, 1.0, 1.0}};
   if (numbers.size() != 3)
   {
      from.Stop("<" + child + "> must have a number for each of three axes");
      return ordered;
   }
   const std::array<int, 3> places = frame.Places(from);
   for (int a = 0; a < 3; a++)
   {
      ordered[places[a]] = numbers[a];
   }
   return ordered;
}

SolidCase ReadEllipsoidal(const FebInput &solid, FebFrame &frame)
{
   SolidCase result;
   result.model = "ellipsoidal_fiber_distribution";
   for (const char *name : {"beta", "ksi"})
   {
      result.vectors[name] = ReadAlongFrame(solid, name, frame);
   }
   return result;
}

SolidCase ReadContinuous(const FebInput &solid, FebFrame &frame)
{
   SolidCase result;
   result.model = "continuous_fiber_distribution";
   solid.Ignore("scheme", "directions are as many as the density needs");
   const std::optional<FebInput> fibers = solid.Find("fibers");
   const std::optional<FebInput> distribution = solid.Find("distribution");
   if (!fibers || !distribution)
   {
      solid.Stop("<fibers> and <distribution> must be there");
      return result;
   }
   const SolidCase law = ReadSolid(*fibers, frame);
   result.fibers = {law.model, law.parameters};
   const LawDescription *known = SolidLaws().Find(law.model);
   if (!known || !known->is_fiber)
   {
      fibers->Stop("this is no law of fibers");
   }
   const std::string type = distribution->NeededAttribute("type");
   if (type == "ellipsoidal")
   {
      result.vectors["spa"] = ReadAlongFrame(*distribution, "spa", frame);
   }
   else if (type == "von-Mises-3d")
   {
      result.parameters["b"] = distribution->Number("b", 0.0);
   }
   else if (type != "spherical")
   {
      distribution->StopAll("distributions of the type \"" + type +
                            "\" are not known; there are spherical, "
                            "ellipsoidal, von-Mises-3d");
   }
   return result;
}
} // namespace

bool IsSolidType(const std::string &type)
{
   const std::vector<LawWords> &words = SolidWords();
   return type == "ellipsoidal fiber distribution" ||
          type == "continuous fiber distribution" || type == "solid mixture" ||
          std::any_of(words.begin(), words.end(),
                      [&type](const LawWords &law) { return law.feb == type; });
}

SolidCase ReadSolid(const FebInput &solid, FebFrame &frame)
{
   SolidCase result;
   solid.Ignore("density", "there is no inertia, and body loads know it");
   const std::string type = solid.Attribute("type");
   if (type == "ellipsoidal fiber distribution")
   {
      return ReadEllipsoidal(solid, frame);
   }
   if (type == "continuous fiber distribution")
   {
      return ReadContinuous(solid, frame);
   }
   if (type == "solid mixture")
   {
      result.model = "mixture";
      for (const FebInput &part : solid.All("solid"))
      {
         result.solids.push_back(ReadSolid(part, frame));
      }
      return result;
   }
   const LawWords *words = FindLaw(solid, SolidWords(),
                                   "solid mixture, continuous fiber "
                                   "distribution, ellipsoidal fiber "
                                   "distribution");
   if (!words)
   {
      return result;
   }
   if (words->law == "porous_neo_hookean")
   {
      solid.Ignore("phi0", "that of the biphasic material counts");
   }
   if (words->law == "trans_iso_mooney_rivlin")
   {
      const std::string model = solid.Word("pressure_model", "default");
      if (model != "default" && model != "0")
      {
         solid.Stop("the pressure_model \"" + model +
                    "\" is not known; there is default, k/2 (ln J)^2");
      }
   }
   const LawDescription &law = *SolidLaws().Find(words->law);
   result.model = words->law;
   result.parameters = ReadParameters(solid, *words, law);
   if (words->law == "prlig")
   {
      // Along the first of its own axes.
      result.vectors["direction"] =
         frame.Components(solid, FirstAxis(ReadAxes(solid, frame.Elements())));
   }
   if (law.is_fiber || words->law == "trans_iso_mooney_rivlin")
   {
      result.vectors["direction"] =
         frame.Components(solid, ReadFiber(solid, frame.Elements()));
   }
   return result;
}

} // namespace synovia
