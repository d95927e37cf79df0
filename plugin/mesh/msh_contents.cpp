#include "synovia/mesh/msh_contents.hpp"
#include "synovia/general/error.hpp"
#include "synovia/general/text.hpp"
#include "synovia/mesh/msh_cursor.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <set>

namespace synovia
{

namespace
{

// MFEM has arrays with a place for each attribute up to the highest.
constexpr int highest_tag = 10000000;

std::string ReadFile(const std::string &path)
{
   std::error_code ignored;
   if (!std::filesystem::exists(path, ignored))
   {
      throw Error("there is no such file");
   }
   if (std::filesystem::is_directory(path, ignored))
   {
      throw Error("this is a directory");
   }
   std::ifstream stream(path, std::ios::binary);
   std::string text((std::istreambuf_iterator<char>(stream)),
                    std::istreambuf_iterator<char>());
   if (!stream)
   {
      throw Error("the file cannot be read");
   }
   if (text.empty())
   {
      throw Error("the file is empty");
   }
   if (text[0] != '$')
   {
      throw Error("this is no gmsh mesh: it does not start with $MeshFormat; "
                  "let gmsh convert it with -save -o NAME.msh, and mesh a "
                  "geometry first");
   }
   return text;
}

class MshReader
{
public:
   explicit MshReader(std::string text) : cursor(std::move(text)) {}

   MshContents Read()
   {
      std::string section;
      while (cursor.NextSection(section))
      {
         if (section != "MeshFormat" && section != "Comments" && version == 0.0)
         {
            cursor.Fail("the section $MeshFormat must come first");
         }
         Section(section);
      }
      for (const char *const needed : {"Nodes", "Elements"})
      {
         if (seen.count(needed) == 0)
         {
            cursor.Fail(std::string("the section $") + needed + " is missing");
         }
      }
      NameGroups(3, contents.volumes);
      NameGroups(2, contents.surfaces);
      return std::move(contents);
   }

private:
   using Dimension = int;
   using Tag = int;

   MshCursor cursor;
   MshContents contents;

   std::set<std::string> seen;
   double version = 0.0;
   bool binary = false;
   std::map<std::pair<Dimension, Tag>, std::string> names;
   // Version 4: physical groups of an entity.
   std::map<std::pair<Dimension, Tag>, std::vector<int>> entity_groups;
   // Places of the sets of groups in the cells of each dimension.
   std::map<std::vector<int>, int> group_places[4];
   // The time step of each view of elements.
   std::map<std::string, int> view_steps;

   void Section(const std::string &section)
   {
      const bool old = version < 3.0;
      const bool first = seen.insert(section).second;
      if (section == "MeshFormat" || section == "Nodes")
      {
         if (!first)
         {
            cursor.Fail("there is a second section $" + section);
         }
         section == "Nodes" ? ReadNodes() : ReadFormat();
      }
      else if (section == "PhysicalNames")
      {
         ReadNames();
      }
      else if (section == "Entities" && !old)
      {
         ReadEntities(false);
      }
      else if (section == "PartitionedEntities" && !old)
      {
         ReadEntities(true);
      }
      else if (section == "Elements")
      {
         old ? ReadOldElements() : ReadElements();
      }
      else if (section == "ElementData")
      {
         ReadElementData();
      }
      else
      {
         cursor.SkipSection(section);
         return;
      }
      cursor.binary = false;
      cursor.EndSection(section);
   }

   void ReadFormat()
   {
      version = cursor.Real();
      binary = cursor.Int() != 0;
      const int size = cursor.Int();
      if (!(version >= 2.0 && version < 3.0) && version != 4.1)
      {
         cursor.Fail("MSH version " + ToText(version) +
                     " is not supported; let gmsh convert the file with "
                     "-save -format msh41 -o NAME.msh");
      }
      if (size != 8)
      {
         cursor.Fail("expected numbers of 8 bytes, found " +
                     std::to_string(size));
      }
      cursor.Line();
      cursor.binary = binary;
      if (binary && cursor.Int() != 1)
      {
         cursor.Fail("the file was written on a machine with another order of "
                     "bytes; save it as ascii there");
      }
   }

   void ReadNames()
   {
      const size_t number = cursor.Count();
      cursor.Line();
      for (size_t i = 0; i < number; i++)
      {
         const int dimension = ReadDimension();
         const int tag = ReadGroup();
         names[{dimension, tag}] = ReadQuoted();
      }
   }

   // What is in quotes in the rest of the line.
   std::string ReadQuoted()
   {
      const std::string line = cursor.Line();
      const size_t start = line.find('"');
      const size_t end = line.rfind('"');
      if (start == end)
      {
         cursor.Fail("expected a name in quotes on the line before");
      }
      return line.substr(start + 1, end - start - 1);
   }

   int ReadDimension()
   {
      const int dimension = cursor.Int();
      if (dimension < 0 || dimension > 3)
      {
         cursor.Fail("there is no dimension " + std::to_string(dimension));
      }
      return dimension;
   }

   void ReadEntities(bool partitioned)
   {
      cursor.binary = binary;
      if (partitioned)
      {
         cursor.Count(); // partitions
         cursor.SkipInts(cursor.Count(), 2);
      }
      size_t number[4];
      for (size_t &n : number)
      {
         n = cursor.Count();
      }
      for (int dimension = 0; dimension < 4; dimension++)
      {
         for (size_t i = 0; i < number[dimension]; i++)
         {
            const int tag = cursor.Int();
            if (partitioned)
            {
               cursor.SkipInts(2); // the entity it is part of
               cursor.SkipInts(cursor.Count());
            }
            cursor.SkipReals(dimension == 0 ? 3 : 6);
            entity_groups[{dimension, tag}] = ReadGroups();
            if (dimension > 0)
            {
               cursor.SkipInts(cursor.Count());
            }
         }
      }
   }

   // A physical tag. It is negative where the group has the entity reversed.
   int ReadGroup()
   {
      const int tag = cursor.Int();
      if (tag > highest_tag || tag < -highest_tag)
      {
         cursor.Fail("the physical tag " + std::to_string(tag) + " is beyond " +
                     std::to_string(highest_tag));
      }
      return std::abs(tag);
   }

   // Ascending and without 0, which means none.
   std::vector<int> ReadGroups()
   {
      const size_t number = cursor.Count();
      std::set<int> groups;
      for (size_t i = 0; i < number; i++)
      {
         groups.insert(ReadGroup());
      }
      groups.erase(0);
      return std::vector<int>(groups.begin(), groups.end());
   }

   void ReadNodes()
   {
      std::vector<size_t> numbers;
      std::vector<double> positions;
      if (version < 3.0)
      {
         const size_t number = cursor.Count();
         cursor.Line();
         cursor.binary = binary;
         for (size_t i = 0; i < number; i++)
         {
            numbers.push_back(ReadNumber());
            ReadPosition(numbers.back(), positions);
         }
      }
      else
      {
         const auto read_block =
            [&](int dimension, int parametric, size_t number)
         {
            const size_t first = numbers.size();
            for (size_t i = 0; i < number; i++)
            {
               numbers.push_back(cursor.Count());
            }
            for (size_t i = 0; i < number; i++)
            {
               ReadPosition(numbers[first + i], positions);
               cursor.SkipReals(parametric ? dimension : 0);
            }
         };
         ReadBlocks("nodes", [&](int dimension, int, int parametric, size_t n)
                    { read_block(dimension, parametric, n); });
      }
      SortNodes(numbers, positions);
   }

   size_t ReadNumber()
   {
      const int number = cursor.Int();
      if (number < 0)
      {
         cursor.Fail("there is a node or an element with the number " +
                     std::to_string(number));
      }
      return number;
   }

   void ReadPosition(size_t number, std::vector<double> &positions)
   {
      for (int d = 0; d < 3; d++)
      {
         positions.push_back(cursor.Real());
         if (!std::isfinite(positions.back()))
         {
            cursor.Fail("node " + std::to_string(number) +
                        " has a coordinate that is not finite");
         }
      }
   }

   void SortNodes(const std::vector<size_t> &numbers,
                  const std::vector<double> &positions)
   {
      std::vector<size_t> order(numbers.size());
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(), order.end(),
                [&](size_t a, size_t b) { return numbers[a] < numbers[b]; });
      for (const size_t i : order)
      {
         if (!contents.node_numbers.empty() &&
             contents.node_numbers.back() == numbers[i])
         {
            cursor.Fail("there are two nodes with the number " +
                        std::to_string(numbers[i]));
         }
         contents.node_numbers.push_back(numbers[i]);
         contents.coordinates.insert(contents.coordinates.end(),
                                     positions.begin() + 3 * i,
                                     positions.begin() + 3 * i + 3);
      }
   }

   // $Nodes and $Elements of version 4 consist of blocks with the same head:
   // read(dimension, entity, form, number).
   template <typename Read>
   void ReadBlocks(const std::string &what, Read read)
   {
      cursor.binary = binary;
      const size_t blocks = cursor.Count();
      const size_t promised = cursor.Count();
      cursor.SkipCounts(2); // lowest and highest number
      size_t there = 0;
      for (size_t i = 0; i < blocks; i++)
      {
         const int dimension = ReadDimension();
         const int entity = cursor.Int();
         const int form = cursor.Int();
         const size_t number = cursor.Count();
         read(dimension, entity, form, number);
         there += number;
      }
      if (there != promised)
      {
         cursor.Fail("the section promises " + std::to_string(promised) + " " +
                     what + " and holds " + std::to_string(there));
      }
   }

   void ReadElements()
   {
      ReadBlocks("elements",
                 [this](int dimension, int entity, int number_of_type, size_t n)
                 {
                    const GmshElementType &type = Type(number_of_type);
                    if (type.dimension != dimension)
                    {
                       cursor.Fail("elements of type \"" + type.name +
                                   "\" do not have the dimension " +
                                   std::to_string(dimension));
                    }
                    const auto groups = entity_groups.find({dimension, entity});
                    for (size_t i = 0; i < n; i++)
                    {
                       const size_t number = cursor.Count();
                       AddCell(number_of_type, number, entity,
                               groups == entity_groups.end()
                                  ? std::vector<int>()
                                  : groups->second);
                       for (int j = 0; j < type.nodes; j++)
                       {
                          AddNode(type, number, cursor.Count());
                       }
                    }
                 });
   }

   void ReadOldElements()
   {
      const size_t number = cursor.Count();
      cursor.Line();
      cursor.binary = binary;
      size_t there = 0;
      while (there < number)
      {
         // An ascii file has the head of a block at each element.
         const size_t element = binary ? 0 : ReadNumber();
         const int type = cursor.Int();
         const size_t block = binary ? ReadNumber() : 1;
         const int tags = cursor.Int();
         if (block == 0 || block > number - there || tags < 0)
         {
            cursor.Fail("the head of a block of elements makes no sense");
         }
         for (size_t i = 0; i < block; i++)
         {
            ReadOldElement(type, binary ? ReadNumber() : element, tags);
         }
         there += block;
      }
   }

   void ReadOldElement(int number_of_type, size_t number, int tags)
   {
      const GmshElementType &type = Type(number_of_type);
      const int group = tags > 0 ? ReadGroup() : 0;
      const int entity = tags > 1 ? cursor.Int() : 0;
      cursor.SkipInts(std::max(tags - 2, 0));
      AddCell(number_of_type, number, entity,
              group ? std::vector<int>(1, group) : std::vector<int>());
      for (int j = 0; j < type.nodes; j++)
      {
         AddNode(type, number, ReadNumber());
      }
   }

   // The head is text in a binary file, too.
   void ReadElementData()
   {
      const size_t texts = cursor.Count();
      cursor.Line();
      std::string name;
      for (size_t i = 0; i < texts; i++)
      {
         const std::string text = ReadQuoted();
         name = i == 0 ? text : name;
      }
      cursor.SkipReals(cursor.Count());
      const size_t counts = cursor.Count();
      if (counts < 3)
      {
         cursor.Fail("data of elements need a time step, a number of "
                     "components and a number of elements");
      }
      const int step = cursor.Int();
      const size_t components = cursor.Count();
      const size_t number = cursor.Count();
      cursor.SkipInts(counts - 3);
      cursor.Line();
      cursor.binary = binary;
      const bool taken = components == 3 &&
                         view_steps.emplace(name, step).first->second == step;
      for (size_t i = 0; i < number; i++)
      {
         const int element = cursor.Int();
         if (!taken)
         {
            cursor.SkipReals(components);
            continue;
         }
         std::array<double, 3> &vector =
            contents.element_vectors[name][element];
         for (double &component : vector)
         {
            component = cursor.Real();
            if (!std::isfinite(component))
            {
               cursor.Fail("the vector of element " + std::to_string(element) +
                           " in \"" + name + "\" is not finite");
            }
         }
      }
   }

   const GmshElementType &Type(int number)
   {
      const GmshElementType &type = GmshType(number);
      if (type.nodes < 1)
      {
         cursor.Fail(
            "there is no element type " + std::to_string(number) +
            ", or it is not supported: complete elements are, and incomplete "
            "ones of order 2");
      }
      return type;
   }

   // The cells of a dimension, or none for what is not needed.
   MshCells *CellsOf(int dimension)
   {
      return dimension == 3   ? &contents.volumes
             : dimension == 2 ? &contents.surfaces
                              : nullptr;
   }

   void AddCell(int type, size_t number, int entity,
                const std::vector<int> &groups)
   {
      const int dimension = GmshType(type).dimension;
      MshCells *const cells = CellsOf(dimension);
      if (!cells)
      {
         return;
      }
      const int next = static_cast<int>(cells->groups.size());
      const auto place = group_places[dimension].emplace(groups, next);
      if (place.second)
      {
         cells->groups.push_back(groups);
      }
      cells->list.push_back({type, static_cast<long long>(number), entity,
                             cells->nodes.size(), place.first->second});
   }

   void AddNode(const GmshElementType &type, size_t element, size_t number)
   {
      const auto found = std::lower_bound(contents.node_numbers.begin(),
                                          contents.node_numbers.end(), number);
      if (found == contents.node_numbers.end() || *found != number)
      {
         cursor.Fail("element " + std::to_string(element) + " has the node " +
                     std::to_string(number) + ", which does not exist");
      }
      MshCells *const cells = CellsOf(type.dimension);
      if (cells)
      {
         cells->nodes.push_back(
            static_cast<int>(found - contents.node_numbers.begin()));
      }
   }

   void NameGroups(int dimension, MshCells &cells) const
   {
      for (const auto &name : names)
      {
         if (name.first.first == dimension)
         {
            cells.names[name.first.second] = name.second;
         }
      }
      for (const std::vector<int> &set : cells.groups)
      {
         for (const int group : set)
         {
            cells.names.emplace(group, std::to_string(group));
         }
      }
   }
};

} // namespace

MshContents ReadMsh(const std::string &path)
{
   return MshReader(ReadFile(path)).Read();
}

} // namespace synovia
