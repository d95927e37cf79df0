#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/feb/feb_report.hpp"

#include <string>

namespace synovia
{

/// A model of FEBio as a case and its mesh.
struct FebImport
{
   /// Its mesh file is a name without a directory.
   CaseFile setup;
   /// An MSH file.
   std::string mesh;
   FebReport report;
};

/// Whether the name of a file ends with .feb.
bool IsFebFile(const std::string &file);

/// Reads a model in FEBio's format 2.5, 3.0 or 4.0, @a source being the file's
/// name. What can't be read is in the report, whose IsStopped() says whether
/// case and mesh are of use. Throws Error if the text is no such file.
FebImport ImportFeb(const std::string &text, const std::string &source);

/// Converts a model: writes NAME.toml and NAME.msh to @a directory, NAME.feb
/// being the file, and prints what was not taken as it is. Returns the case
/// file. Collective: rank 0 reads and writes. Throws Error, which lists all
/// that is not supported, or says why a file can't be read or written.
std::string ConvertFeb(const std::string &file, const std::string &directory,
                       MPI_Comm comm);

} // namespace synovia
