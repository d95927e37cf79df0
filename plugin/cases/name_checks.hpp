#pragma once

#include "synovia/cases/case_reading.hpp"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace synovia
{

/// Adds an error for the second of two entries with the same name.
class Once
{
public:
   /// Borrows @a reading.
   explicit Once(CaseReading &reading_) : reading(reading_) {}

   void Enter(const std::string &name, const std::string &path,
              const std::string &problem);

private:
   CaseReading &reading;
   std::map<std::string, std::string> paths;
};

std::set<std::string> Distinct(const std::vector<std::string> &names);

/// Adds errors unless there are names of a @a kind of thing, each once.
void CheckNames(const std::vector<std::string> &names, const std::string &path,
                const std::string &kind, CaseReading &reading);

/// Adds an error for what can't be part of file names and of the history's
/// columns.
void CheckFileName(const std::string &name, const std::string &path,
                   CaseReading &reading);

} // namespace synovia
