#include "synovia/feb/feb_element.hpp"
#include "synovia/general/error.hpp"

#include <algorithm>
#include <cstddef>
#include <pugixml.hpp>

namespace synovia
{

namespace
{
// Models have ten levels.
constexpr int deepest = 100;

/// Lines of places in a text.
class LineTable
{
public:
   explicit LineTable(const std::string &text)
   {
      for (size_t i = 0; i < text.size(); i++)
      {
         if (text[i] == '\n')
         {
            ends.push_back(i);
         }
      }
   }
   int Line(ptrdiff_t place) const
   {
      const auto end = std::lower_bound(ends.begin(), ends.end(), place);
      return static_cast<int>(end - ends.begin()) + 1;
   }

private:
   std::vector<ptrdiff_t> ends;
};

std::string Trimmed(const std::string &text)
{
   constexpr const char *white = " \t\r\n";
   const size_t first = text.find_first_not_of(white);
   return first == std::string::npos
             ? ""
             : text.substr(first, text.find_last_not_of(white) - first + 1);
}

[[noreturn]] void Fail(const std::string &source, int line,
                       const std::string &problem)
{
   throw Error(source + ":" + std::to_string(line) + ": " + problem);
}

FebElement Copy(const pugi::xml_node &node, const LineTable &lines,
                const std::string &source, int depth)
{
   FebElement element;
   element.name = node.name();
   element.line = lines.Line(node.offset_debug());
   if (depth > deepest)
   {
      Fail(source, element.line, "elements are nested too deeply for a model");
   }
   for (const pugi::xml_attribute &attribute : node.attributes())
   {
      element.attributes.push_back({attribute.name(), attribute.value()});
   }
   for (const pugi::xml_node &child : node.children())
   {
      if (child.type() == pugi::node_element)
      {
         element.children.push_back(Copy(child, lines, source, depth + 1));
      }
      else if (child.type() == pugi::node_pcdata ||
               child.type() == pugi::node_cdata)
      {
         element.text += child.value();
      }
   }
   element.text = Trimmed(element.text);
   return element;
}
} // namespace

FebElement ParseXml(const std::string &text, const std::string &source)
{
   const LineTable lines(text);
   pugi::xml_document document;
   // Taken as it is, whatever encoding it names, so that places are those in
   // the file.
   const pugi::xml_parse_result result = document.load_buffer(
      text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
   if (!result)
   {
      Fail(source, lines.Line(result.offset),
           std::string("this is no XML: ") + result.description());
   }
   const pugi::xml_node root = document.document_element();
   const pugi::xml_node second = root.next_sibling();
   if (second)
   {
      Fail(source, lines.Line(second.offset_debug()),
           "there is something after the end of <" + std::string(root.name()) +
              ">");
   }
   return Copy(root, lines, source, 0);
}

} // namespace synovia
