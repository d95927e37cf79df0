#pragma once

#include "synovia/general/error.hpp"
#include "synovia/materials/law_arguments.hpp"
#include "synovia/materials/law_description.hpp"
#include "synovia/materials/permeability_law.hpp"
#include "synovia/materials/solid_law.hpp"

#include <memory>
#include <string>
#include <vector>

namespace synovia
{

/// The laws that case files can name. @a Law is SolidLaw or PermeabilityLaw.
template <typename Law>
class LawRegistry
{
public:
   struct Entry
   {
      LawDescription description;
      std::unique_ptr<Law> (*make)(const LawArguments &);
   };

   /// Adds a class that has
   ///
   ///     static LawDescription Describe();
   ///     explicit Own(const LawArguments &from);
   ///
   /// Throws Error if there is a law of that name.
   template <typename Own>
   void Add()
   {
      LawDescription description = Own::Describe();
      if (Find(description.name))
      {
         throw Error("there is a law called \"" + description.name +
                     "\" already; give this one another name");
      }
      entries.push_back({std::move(description),
                         [](const LawArguments &from) -> std::unique_ptr<Law>
                         { return std::make_unique<Own>(from); }});
   }

   const std::vector<Entry> &Entries() const { return entries; }

   /// The description of a law; null if there is none of that name.
   const LawDescription *Find(const std::string &name) const
   {
      const Entry *entry = FindEntry(name);
      return entry ? &entry->description : nullptr;
   }

   /// The names of the laws for a deformation.
   std::vector<std::string> Names(Deformation deformation) const
   {
      std::vector<std::string> names;
      for (const Entry &entry : entries)
      {
         if (entry.description.Allows(deformation))
         {
            names.push_back(entry.description.name);
         }
      }
      return names;
   }

   /// Makes a law; parameters that are not given have their standard values.
   /// Throws Error if there is no such law, if a required parameter is missing,
   /// and if values are out of range.
   std::unique_ptr<Law> Make(const std::string &name, LawArguments from) const
   {
      const Entry *const entry = FindEntry(name);
      if (!entry)
      {
         throw Error("there is no law called \"" + name + "\"");
      }
      for (const LawParameter &parameter : entry->description.parameters)
      {
         if (parameter.standard)
         {
            from.values.emplace(parameter.name, *parameter.standard);
         }
         if (!from.values.count(parameter.name))
         {
            throw Error(parameter.name + " of \"" + name + "\" is missing (" +
                        parameter.noun + ")");
         }
      }
      for (const LawVector &vector : entry->description.vectors)
      {
         if (vector.standard)
         {
            from.vectors.emplace(vector.name, *vector.standard);
         }
         if (!from.vectors.count(vector.name))
         {
            throw Error(vector.name + " of \"" + name + "\" is missing (" +
                        vector.noun + ")");
         }
      }
      return entry->make(from);
   }

private:
   const Entry *FindEntry(const std::string &name) const
   {
      for (const Entry &entry : entries)
      {
         if (entry.description.name == name)
         {
            return &entry;
         }
      }
      return nullptr;
   }

   std::vector<Entry> entries;
};

/// Those of materials/solids and materials/permeabilities, and what a program
/// adds before it reads a case.
LawRegistry<SolidLaw> &SolidLaws();
LawRegistry<PermeabilityLaw> &PermeabilityLaws();

} // namespace synovia
