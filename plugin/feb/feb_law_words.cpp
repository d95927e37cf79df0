#include "synovia/feb/feb_law_words.hpp"
#include "synovia/general/error.hpp"

namespace synovia
{

using namespace mfem;

const LawWords *FindLaw(const FebInput &from,
                        const std::vector<LawWords> &words,
                        const std::string &also)
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

} // namespace synovia
