#include "synovia/feb/feb_element_data.hpp"
#include "synovia/feb/feb_model.hpp"
#include "synovia/feb/feb_ranges.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>

namespace synovia
{

namespace
{
// Numbers of the corners of elements of the case.
std::set<long long> CornerNumbers(const FebModel &model)
{
   std::set<long long> corners;
   for (const FebPart &part : model.mesh.parts)
   {
      for (const FebCell &cell : part.cells)
      {
         for (int i = 0; i < part.shape->corners; i++)
         {
            if (model.surfaces->IsUsed(cell.nodes[i]))
            {
               corners.insert(model.mesh.numbers[cell.nodes[i]]);
            }
         }
      }
   }
   return corners;
}

std::set<long long> ElementNumbers(const FebModel &model)
{
   std::set<long long> elements;
   for (const std::set<int> *parts :
        {&model.materials.deformable, &model.touching})
   {
      for (const int part : *parts)
      {
         for (const FebCell &cell : model.mesh.parts[part].cells)
         {
            elements.insert(cell.number);
         }
      }
   }
   return elements;
}

// Keeps those that the case has.
void KeepKnown(const FebInput &table, const std::set<long long> &known,
               const std::string &what, LogDefinition &log,
               std::vector<long long> numbers)
{
   std::sort(numbers.begin(), numbers.end());
   numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
   bool all = true;
   for (const long long number : numbers)
   {
      if (known.count(number) > 0 && number <= std::numeric_limits<int>::max())
      {
         log.numbers.push_back(static_cast<int>(number));
      }
      else
      {
         all = false;
      }
   }
   if (!all)
   {
      table.Approximate("the log leaves out " + what);
   }
}

std::vector<long long> NodesOfTable(const FebInput &table, FebModel &model)
{
   const std::string set = table.Attribute("node_set");
   std::vector<long long> numbers = ReadRanges(table);
   if (!set.empty())
   {
      const std::vector<int> *nodes = model.surfaces->FindNodes(set);
      if (!nodes)
      {
         table.Stop("there is no set of nodes called \"" + set + "\"");
         return {};
      }
      for (const int node : *nodes)
      {
         numbers.push_back(model.mesh.numbers[node]);
      }
   }
   return numbers;
}

std::vector<long long> ElementsOfTable(const FebInput &table,
                                       const FebInput &root,
                                       const FebModel &model)
{
   const std::string name = table.Attribute("elem_set");
   std::vector<long long> numbers = ReadRanges(table);
   if (name.empty())
   {
      return numbers;
   }
   const std::vector<long long> of_set = ElementsOfSet(name, root, model.mesh);
   numbers.insert(numbers.end(), of_set.begin(), of_set.end());
   if (numbers.empty())
   {
      table.Stop("there is no set of elements called \"" + name + "\"");
   }
   return numbers;
}

void ReadBodies(const FebInput &table, FebModel &model, LogDefinition &log)
{
   for (const long long number : ReadRanges(table))
   {
      const RigidBodyCase *body =
         model.FindRigid(std::to_string(number), table);
      if (body)
      {
         log.rigid_bodies.push_back(body->name);
      }
   }
   if (!model.setup.rigid_bodies.empty())
   {
      table.Approximate("rigid bodies are numbered from 1, in the order of "
                        "the case");
   }
}

// Names that are known; the others are left out.
void ReadData(const FebInput &table, LogDefinition &log)
{
   const std::vector<std::string> &known = LogData(log.of);
   std::istringstream words(table.NeededAttribute("data"));
   std::string unknown;
   for (std::string word; std::getline(words, word, ';');)
   {
      if (std::find(known.begin(), known.end(), word) != known.end())
      {
         log.data.push_back(word);
      }
      else
      {
         unknown += (unknown.empty() ? "\"" : ", \"") + word + "\"";
      }
   }
   if (!unknown.empty())
   {
      table.Approximate("the log leaves out " + unknown);
   }
}

std::string FileOf(const FebInput &table, const std::string &word,
                   const FebModel &model)
{
   const auto is_taken = [&model](const std::string &name)
   {
      return std::any_of(
         model.setup.output.logs.begin(), model.setup.output.logs.end(),
         [&name](const LogDefinition &log) { return log.file == name; });
   };
   const std::string file = table.Attribute("file");
   const std::string name = PlainName(
      file.empty() ? word + ".txt" : file.substr(file.find_last_of("/\\") + 1));
   std::string fresh = name;
   for (int i = 2; is_taken(fresh); i++)
   {
      fresh = std::to_string(i) + "_" + name;
   }
   return fresh;
}

void ReadTable(const FebInput &table, const FebInput &root, FebModel &model)
{
   LogDefinition log;
   const std::string &kind = table.Name();
   if (kind != "node_data" && kind != "element_data" &&
       kind != "rigid_body_data")
   {
      table.IgnoreAll("there are logs of nodes, elements and rigid bodies");
      return;
   }
   log.of = kind == "node_data"      ? LogSubject::nodes
            : kind == "element_data" ? LogSubject::elements
                                     : LogSubject::rigid_bodies;
   table.Attribute("name");
   ReadData(table, log);
   if (table.HasAttribute("delim"))
   {
      const std::string delimiter = table.Attribute("delim");
      log.delimiter = delimiter.empty() ? log.delimiter : delimiter;
   }
   if (table.HasAttribute("format"))
   {
      table.Approximate("the format \"" + table.Attribute("format") +
                        "\" is left out: columns are separated by \"" +
                        log.delimiter + "\"");
   }
   const bool all = ReadRanges(table).empty() &&
                    table.Attribute("node_set").empty() &&
                    table.Attribute("elem_set").empty();
   if (log.of == LogSubject::rigid_bodies)
   {
      ReadBodies(table, model, log);
   }
   else if (!all && log.of == LogSubject::nodes)
   {
      KeepKnown(table, CornerNumbers(model),
                "nodes that are no corners of elements", log,
                NodesOfTable(table, model));
   }
   else if (!all)
   {
      KeepKnown(table, ElementNumbers(model), "elements of rigid bodies", log,
                ElementsOfTable(table, root, model));
   }
   const bool nothing = log.of == LogSubject::rigid_bodies
                           ? model.setup.rigid_bodies.empty()
                           : !all && log.numbers.empty();
   if (log.data.empty() || nothing)
   {
      table.IgnoreAll("nothing is left to be logged");
      return;
   }
   log.file = FileOf(table, kind, model);
   model.setup.output.logs.push_back(log);
}
} // namespace

void ReadOutput(const FebInput &root, FebModel &model)
{
   root.Ignore("Globals", "they are constants of solutes");
   const std::optional<FebInput> output = root.Find("Output");
   if (!output)
   {
      return;
   }
   output->Ignore("plotfile", "fields/ has all fields of each step");
   for (const FebInput &logs : output->All("logfile"))
   {
      logs.Attribute("file");
      for (const FebInput &table : logs.All())
      {
         ReadTable(table, root, model);
      }
   }
}

} // namespace synovia
