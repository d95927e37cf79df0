#include "synovia/cases/case_words.hpp"
#include "synovia/general/error.hpp"

namespace synovia
{

namespace
{
template <typename Enum>
Enum Find(const KeyWords<Enum> &words, const std::string &what,
          const std::string &word)
{
   std::string all;
   for (const auto &[known, value] : words)
   {
      if (known == word)
      {
         return value;
      }
      all += (all.empty() ? "" : ", ") + known;
   }
   throw Error("no " + what + " is named \"" + word + "\"; there are: " + all);
}
} // namespace

const KeyWords<TimeScheme> &TimeSchemeWords()
{
   static const KeyWords<TimeScheme> words{
      {"backward_euler", TimeScheme::backward_euler},
      {"sdirk23", TimeScheme::sdirk23},
      {"sdirk33", TimeScheme::sdirk33}};
   return words;
}

const KeyWords<LinearMethod> &LinearMethodWords()
{
   static const KeyWords<LinearMethod> words{
      {"auto", LinearMethod::automatic},
      {"block_amg", LinearMethod::block_amg},
      {"direct", LinearMethod::direct}};
   return words;
}

const KeyWords<DirectLibrary> &DirectLibraryWords()
{
   static const KeyWords<DirectLibrary> words{
      {"auto", DirectLibrary::automatic},
      {"mumps", DirectLibrary::mumps},
      {"umfpack", DirectLibrary::umfpack}};
   return words;
}

const KeyWords<Deformation> &DeformationWords()
{
   static const KeyWords<Deformation> words{
      {"infinitesimal", Deformation::infinitesimal},
      {"finite", Deformation::finite}};
   return words;
}

const KeyWords<LogSubject> &LogSubjectWords()
{
   static const KeyWords<LogSubject> words{
      {"nodes", LogSubject::nodes},
      {"elements", LogSubject::elements},
      {"rigid_bodies", LogSubject::rigid_bodies}};
   return words;
}

std::string DeformationWord(Deformation deformation)
{
   return WordFor(deformation, DeformationWords());
}

TimeScheme TimeSchemeNamed(const std::string &word)
{
   return Find(TimeSchemeWords(), "time scheme", word);
}

LinearMethod LinearMethodNamed(const std::string &word)
{
   return Find(LinearMethodWords(), "linear solver", word);
}

} // namespace synovia
