#include "synovia/cases/law_keys.hpp"
#include "synovia/materials/law_registry.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
using LawValues = std::map<std::string, real_t>;
using Alternatives = std::vector<KeyTable::Alternative>;

const char *const model = "model";

/// A parameter of a law, which may be left out where it has a standard value:
/// a LawParameter, which is a number, or a LawVector, which is three.
template <typename Parameter, typename Value>
class ParameterBinding : public KeyBinding
{
public:
   ParameterBinding(const Parameter &parameter_,
                    std::map<std::string, Value> &values_)
      : parameter(parameter_), values(values_)
   {
   }
   std::string Type() const override { return type_name<Value>; }
   TomlText Text() const override
   {
      const std::optional<Value> value = Present();
      return value ? TextOf(*value) : TomlText();
   }
   bool IsSet() const override { return Present().has_value(); }
   void Read(const CaseInput &from) override
   {
      Value value{};
      ReadValue(from, value);
      if (!from.HasError())
      {
         values[parameter.name] = value;
      }
   }
   std::optional<real_t> Number() const override
   {
      if constexpr (std::is_same_v<Value, real_t>)
      {
         return Present();
      }
      return std::nullopt;
   }

private:
   std::optional<Value> Present() const
   {
      const auto found = values.find(parameter.name);
      return found == values.end() ? parameter.standard : found->second;
   }

   Parameter parameter;
   std::map<std::string, Value> &values;
};

template <typename Parameter, typename Value>
void AddKeys(const std::vector<Parameter> &parameters,
             std::map<std::string, Value> &values, KeyTable &keys)
{
   using Binding = ParameterBinding<Parameter, Value>;
   for (const Parameter &parameter : parameters)
   {
      CaseKey &key =
         keys.Bind(parameter.name, std::make_unique<Binding>(parameter, values),
                   parameter.unit, parameter.noun);
      key.In(parameter.range).Named(parameter.noun);
      if (!parameter.standard)
      {
         key.Required();
      }
   }
}

KeyTable ParameterKeys(const LawDescription &law, LawValues &values)
{
   KeyTable keys;
   AddKeys(law.parameters, values, keys);
   return keys;
}

bool IsAny(const LawDescription &)
{
   return true;
}

bool IsPart(const LawDescription &law)
{
   return !law.has_parts;
}

bool IsFiber(const LawDescription &law)
{
   return law.is_fiber;
}

template <typename Law>
Alternatives Described(const LawRegistry<Law> &laws,
                       bool (*is_meant)(const LawDescription &))
{
   Alternatives alternatives;
   for (const auto &entry : laws.Entries())
   {
      const LawDescription &law = entry.description;
      if (is_meant(law))
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

/// The laws that are meant, one of which a key chooses, with its own keys.
template <typename Law>
KeyTable LawKeys(const LawRegistry<Law> &laws, std::string &name,
                 bool (*is_meant)(const LawDescription &),
                 const std::function<KeyTable(const LawDescription &)> &own,
                 const std::string &meaning)
{
   KeyTable keys;
   keys.Choice(
      model, name, Described(laws, is_meant),
      [&laws, own](const std::string &word) { return own(*laws.Find(word)); },
      meaning);
   return keys;
}

KeyTable FiberKeys(FiberCase &fibers)
{
   return LawKeys(
      SolidLaws(), fibers.model, IsFiber,
      [&fibers](const LawDescription &law)
      { return ParameterKeys(law, fibers.parameters); },
      "law of the fibers, one of:");
}

// Of a law that isn't made of other bodies.
KeyTable SimpleKeys(const LawDescription &law, SolidCase &solid)
{
   KeyTable keys = ParameterKeys(law, solid.parameters);
   AddKeys(law.vectors, solid.vectors, keys);
   if (law.has_fibers)
   {
      keys.Table("fibers", FiberKeys(solid.fibers), "");
   }
   return keys;
}

KeyTable PartKeys(SolidCase &part)
{
   return LawKeys(
      SolidLaws(), part.model, IsPart,
      [&part](const LawDescription &law) { return SimpleKeys(law, part); }, "");
}
} // namespace

KeyTable SolidKeys(SolidCase &solid)
{
   const auto own = [&solid](const LawDescription &law)
   {
      KeyTable keys = SimpleKeys(law, solid);
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
   return LawKeys(SolidLaws(), solid.model, IsAny, own,
                  "law of the drained solid, one of:");
}

KeyTable PermeabilityKeys(PermeabilityCase &permeability)
{
   Alternatives laws = Described(PermeabilityLaws(), IsAny);
   laws.push_back({PermeabilityCase::none, "no fluid: an elastic solid"});
   KeyTable keys;
   keys.Choice(
      model, permeability.model, laws,
      [&permeability](const std::string &word)
      {
         return word == PermeabilityCase::none
                   ? KeyTable()
                   : ParameterKeys(*PermeabilityLaws().Find(word),
                                   permeability.parameters);
      },
      "law of the permeability, one of:");
   return keys;
}

} // namespace synovia
