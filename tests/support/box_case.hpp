#pragma once

#include "support/boxes.hpp"
#include "synovia/cases/case_problem.hpp"
#include "synovia/general/error.hpp"

#include <catch2/catch.hpp>

#include <string>

namespace synovia
{

/// A text with the first of its parts @a from replaced; there must be one.
inline std::string Replaced(std::string text, const std::string &from,
                            const std::string &to)
{
   const size_t at = text.find(from);
   REQUIRE(at != std::string::npos);
   return text.replace(at, from.size(), to);
}

/// What is said against a case on the box of BoxOptions(); empty if nothing is.
/// Collective.
inline std::string ErrorOf(const std::string &text)
{
   try
   {
      const CaseFile setup = ParseCase(text, "case.toml");
      NamedMesh mesh = MakeBox(BoxOptions());
      CaseProblem problem(setup, mesh);
   }
   catch (const Error &error)
   {
      return error.what();
   }
   return "";
}

} // namespace synovia
