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

bool IsUtf8(const std::string &text)
{
   size_t following = 0;
   for (const char c : text)
   {
      const auto byte = static_cast<unsigned char>(c);
      if (following > 0)
      {
         if ((byte & 0xC0) != 0x80)
         {
            return false;
         }
         following--;
      }
      else if (byte >= 0x80)
      {
         following = (byte & 0xE0) == 0xC0   ? 1
                     : (byte & 0xF0) == 0xE0 ? 2
                     : (byte & 0xF8) == 0xF0 ? 3
                                             : 0;
         if (following == 0)
         {
            return false;
         }
      }
   }
   return following == 0;
}

// ISO-8859-1, which models name as their encoding.
std::string FromLatin1(const std::string &text)
{
   std::string utf8;
   for (const char c : text)
   {
      const auto byte = static_cast<unsigned char>(c);
      if (byte < 0x80)
      {
         utf8 += c;
      }
      else
      {
         utf8 += static_cast<char>(0xC0 | (byte >> 6));
         utf8 += static_cast<char>(0x80 | (byte & 0x3F));
      }
   }
   return utf8;
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

FebElement ParseXml(const std::string &given, const std::string &source)
{
   const std::string text = IsUtf8(given) ? given : FromLatin1(given);
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
