// ranks: 1
//
// Laws of FEBio by their names and those of their parameters: what law of ours
// they become, with each value in its place.

#include "support/feb_text.hpp"
#include "synovia/cases/case_file.hpp"
#include "synovia/feb/feb_import.hpp"

#include <catch2/catch.hpp>

#include <map>

using namespace mfem;
using namespace synovia;

namespace
{
using Fate = FebReport::Fate;

/// FEBio's law with the names of its parameters, and ours: parameters have
/// values in their order.
struct SameLaw
{
   std::string feb;
   std::string ours;
   std::vector<std::pair<std::string, std::string>> parameters;
};

const std::vector<SameLaw> solids{
   {"neo-Hookean", "neo_hookean", {{"E", "E"}, {"v", "nu"}}},
   {"Holmes-Mow", "holmes_mow", {{"E", "E"}, {"v", "nu"}, {"beta", "beta"}}},
   {"isotropic elastic", "saint_venant_kirchhoff", {{"E", "E"}, {"v", "nu"}}},
   {"coupled Mooney-Rivlin",
    "mooney_rivlin",
    {{"c1", "c1"}, {"c2", "c2"}, {"k", "k"}}},
   {"porous neo-Hookean", "porous_neo_hookean", {{"E", "E"}}}};

const std::vector<SameLaw> fibers{
   {"fiber-exp-pow",
    "fiber_exp_pow",
    {{"alpha", "alpha"}, {"beta", "beta"}, {"ksi", "ksi"}, {"mu", "mu"}}},
   {"fiber-pow-linear",
    "fiber_pow_linear",
    {{"E", "E"}, {"beta", "beta"}, {"lam0", "lam0"}}},
   {"fiber-NH", "fiber_nh", {{"mu", "mu"}}},
   {"fiber-natural-NH",
    "fiber_natural_nh",
    {{"ksi", "ksi"}, {"lam0", "lam0"}}}};

const std::vector<SameLaw> permeabilities{
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

// Another value for each place, in the range of all.
real_t ValueOf(const std::string &name, size_t place)
{
   const std::map<std::string, real_t> special{
      {"v", 0.2}, {"beta", 2.5}, {"lam0", 1.25}};
   const auto found = special.find(name);
   return found == special.end() ? 0.5 + 0.25 * static_cast<real_t>(place)
                                 : found->second;
}

std::string Text(const SameLaw &law, const std::string &element)
{
   std::string text = "<" + element + " type=\"" + law.feb + "\">";
   for (size_t i = 0; i < law.parameters.size(); i++)
   {
      const std::string &name = law.parameters[i].first;
      text += "<" + name + ">" + std::to_string(ValueOf(name, i)) + "</" +
              name + ">";
   }
   return text + "</" + element + ">";
}

// The column with another solid or permeability.
MaterialCase MaterialWith(const std::string &element, const std::string &law)
{
   const std::string text = FebColumn();
   const size_t begin = text.find("<" + element + " ");
   const std::string close = "</" + element + ">";
   const size_t end = text.find(close, begin) + close.size();
   const FebImport import =
      ImportFeb(text.substr(0, begin) + law + text.substr(end), "model.feb");
   CHECK(import.report.Text(Fate::unsupported) == "");
   REQUIRE(import.setup.materials.size() == 1);
   CheckCase(import.setup);
   return import.setup.materials[0];
}

void CheckParameters(const SameLaw &law,
                     const std::map<std::string, real_t> &values)
{
   CHECK(values.size() == law.parameters.size());
   for (size_t i = 0; i < law.parameters.size(); i++)
   {
      const auto &[name, ours] = law.parameters[i];
      CAPTURE(name, ours);
      REQUIRE(values.count(ours) == 1);
      CHECK(values.at(ours) == Approx(ValueOf(name, i)));
   }
}
} // namespace

TEST_CASE("Solids keep their parameters")
{
   for (const SameLaw &law : solids)
   {
      CAPTURE(law.feb);
      const SolidCase solid = MaterialWith("solid", Text(law, "solid")).solid;
      CHECK(solid.model == law.ours);
      CheckParameters(law, solid.parameters);
   }
}

TEST_CASE("Fibers in a mixture keep theirs")
{
   for (const SameLaw &law : fibers)
   {
      CAPTURE(law.feb);
      const SolidCase solid =
         MaterialWith("solid", "<solid type=\"solid mixture\">" +
                                  Text(solids[0], "solid") +
                                  Text(law, "solid") + "</solid>")
            .solid;
      CHECK(solid.model == "mixture");
      REQUIRE(solid.solids.size() == 2);
      CHECK(solid.solids[1].model == law.ours);
      CheckParameters(law, solid.solids[1].parameters);
   }
}

TEST_CASE("Permeabilities keep theirs")
{
   for (const SameLaw &law : permeabilities)
   {
      CAPTURE(law.feb);
      const PermeabilityCase permeability =
         MaterialWith("permeability", Text(law, "permeability")).permeability;
      CHECK(permeability.model == law.ours);
      CheckParameters(law, permeability.parameters);
   }
}

TEST_CASE("An orthotropic permeability is along the axes of the frame")
{
   const PermeabilityCase permeability =
      MaterialWith("permeability",
                   R"(<permeability type="perm-ref-ortho"><perm0>0.01</perm0>
		<perm1>1,2,3</perm1><perm2>4,5,6</perm2><M0>0.5</M0><alpha0>2</alpha0>
		<M>0.1,0.2,0.3</M><alpha>7,8,9</alpha></permeability>)")
         .permeability;
   CHECK(permeability.model == "referential_orthotropic");
   const std::map<std::string, real_t> &values = permeability.parameters;
   CHECK(values.at("k0") == 0.01);
   CHECK(values.at("M0") == 0.5);
   CHECK(values.at("alpha0") == 2.0);
   // The first axis is theta, the second r, the third z.
   CHECK(values.at("k1_theta") == 1.0);
   CHECK(values.at("k1_r") == 2.0);
   CHECK(values.at("k1_z") == 3.0);
   CHECK(values.at("k2_theta") == 4.0);
   CHECK(values.at("M_r") == 0.2);
   CHECK(values.at("alpha_z") == 9.0);
}
