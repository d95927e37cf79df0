#include "synovia/general/version.hpp"

#include "mfem.hpp"

#include <HYPRE_utilities.h>

namespace synovia
{

namespace
{
std::string MpiVersion()
{
   char text[MPI_MAX_LIBRARY_VERSION_STRING];
   int length = 0;
   MPI_Get_library_version(text, &length);
   const std::string version(text, length);
   // The first part is the name with the version, details follow.
   return version.substr(0, version.find_first_of(",\n"));
}
} // namespace

std::string Version()
{
   return SYNOVIA_VERSION;
}

std::vector<std::pair<std::string, std::string>> Versions()
{
   std::string mfem = mfem::GetVersionStr();
   mfem = mfem.substr(mfem.find_first_of("0123456789"));
   return {{"synovia", Version()},
           {"MFEM", mfem},
           {"hypre", HYPRE_RELEASE_VERSION},
           {"MPI", MpiVersion()}};
}

std::string VersionsText()
{
   std::string text;
   for (const auto &[name, version] : Versions())
   {
      text += (text.empty() ? "" : ", ") + name + " " + version;
   }
   return text;
}

} // namespace synovia
