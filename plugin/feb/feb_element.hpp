#pragma once

#include <string>
#include <vector>

namespace synovia
{

struct FebAttribute
{
   std::string name;
   std::string value;
};

/// An element of an XML file.
struct FebElement
{
   std::string name;
   /// Without the white space around it.
   std::string text;
   /// From 1; where its name is.
   int line = 0;
   std::vector<FebAttribute> attributes;
   std::vector<FebElement> children;
};

/// Reads XML and returns the root. Throws Error with @a source, line and
/// reason if it is damaged, or nested too deeply to be a model.
FebElement ParseXml(const std::string &text, const std::string &source);

} // namespace synovia
