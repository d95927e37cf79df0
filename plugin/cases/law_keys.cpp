#include "synovia/cases/law_keys.hpp"
#include "synovia/materials/law_registry.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
using Values = std::map<std::string, real_t>;
using Alternatives = std::vector<KeyTable::Alternative>;

const char *const model = "model";

/// A parameter of a law, which may be left out where it has a standard value.
class ParameterBinding : public KeyBinding
{
public:
   ParameterBinding(const LawParameter &parameter_, Values &values_)
      : parameter(parameter_), values(values_)
   {
   }
   std::string Type() const override { return type_name<real_t>; }
   TomlText Text() const override
   {
      const std::optional<real_t> number = Number();
      return number ? TextOf(*number) : TomlText();
   }
   bool IsSet() const override { return Number().has_value(); }
   void Read(const CaseInput &from) override
   {
      real_t value = 0.0;
      ReadValue(from, value);
      if (!from.HasError())
      {
         values[parameter.name] = value;
      }
   }
   std::optional<real_t> Number() const override
   {
      const auto found = values.find(parameter.name);
      return found == values.end() ? parameter.standard : found->second;
   }

private:
   LawParameter parameter;
   Values &values;
};

KeyTable ParameterKeys(const LawDescription &law, Values &values)
{
   KeyTable keys;
   for (const LawParameter &parameter : law.parameters)
   {
      CaseKey &key = keys.Bind(
         parameter.name, std::make_unique<ParameterBinding>(parameter, values),
         parameter.unit, parameter.noun);
      key.In(parameter.range).Named(parameter.noun);
      if (!parameter.standard)
      {
         key.Required();
      }
   }
   return keys;
}

template <typename Law>
Alternatives Described(const LawRegistry<Law> &laws, bool with_parts)
{
   Alternatives alternatives;
   for (const auto &entry : laws.Entries())
   {
      const LawDescription &law = entry.description;
      if (with_parts || !law.has_parts)
      {
         const std::string deformation =
            law.only_for
               ? "; " + DeformationWord(*law.only_for) + " deformation"
               : "";
         alternatives.push_back({law.name, law.meaning + deformation});
      }
   }
   return alternatives;
}

KeyTable PartKeys(SolidCase &part)
{
   KeyTable keys;
   keys.Choice(
      model, part.model, Described(SolidLaws(), false),
      [&part](const std::string &word)
      { return ParameterKeys(*SolidLaws().Find(word), part.parameters); },
      "");
   return keys;
}
} // namespace

KeyTable SolidKeys(SolidCase &solid)
{
   const auto describe = [&solid](const std::string &word)
   {
      const LawDescription &law = *SolidLaws().Find(word);
      KeyTable keys = ParameterKeys(law, solid.parameters);
      if (law.has_parts)
      {
         CaseKey &parts = keys.List<SolidCase>(
            "solids", solid.solids, PartKeys,
            "what it is made of: tables with the keys of solids");
         parts.Required();
         parts.list->sample = nullptr;
      }
      return keys;
   };
   KeyTable keys;
   keys.Choice(model, solid.model, Described(SolidLaws(), true), describe,
               "law of the drained solid, one of:");
   return keys;
}

KeyTable PermeabilityKeys(PermeabilityCase &permeability)
{
   KeyTable keys;
   keys.Choice(
      model, permeability.model, Described(PermeabilityLaws(), true),
      [&permeability](const std::string &word)
      {
         return ParameterKeys(*PermeabilityLaws().Find(word),
                              permeability.parameters);
      },
      "law of the permeability, one of:");
   return keys;
}

} // namespace synovia
