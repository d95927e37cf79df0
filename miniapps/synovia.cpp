//                  Synovia: runs a case that a file describes
//
//   mpirun -np 2 synovia indentation.toml
//
// The file names the mesh, the materials of its regions, what is prescribed on
// its surfaces, which of them touch, and what to write. `synovia --dry-schema`
// lists all keys; miniapps/cases/ has examples, which open with what they are
// and how to run them.
//
// Writes to the output directory: history.csv, history.h5 (a row for each
// step), lines/ (profiles), logs/ (tables), fields/ (ParaView), checkpoint/,
// run.log, and case.toml, the case as it ran. Ctrl-C lets the step end and
// writes a checkpoint; --resume goes on from it, on any number of ranks. The
// directory belongs to one run: --overwrite removes what an earlier one left
// there.
//
// Sample runs:
//   cd miniapps/cases
//   ../../scripts/run_python ../../meshes/boxes.py confined_compression
//   mpirun -np 2 synovia confined_compression.toml
//   synovia confined_compression.toml --check
//   synovia confined_compression.toml --set time.step=50 --output out/coarse
//   synovia confined_compression.toml --resume

#include "synovia/synovia.hpp"

#include "synovia/feb/feb_import.hpp"
#include "synovia/general/suggestion.hpp"
#include "synovia/general/version.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <sstream>

using namespace synovia;

namespace
{

constexpr const char *usage =
   R"(usage: synovia CASE.toml [OPTION...]     (also with mpirun -np N before it)
       synovia MODEL.feb [OPTION...]     a model of FEBio

  --check               stop after the check, and print the problem
  --set KEY.PATH=VALUE  override a key; the value as in the file, such as
                        time.step=5 or 'output.directory="out"'. Entries of lists
                        go by number from 0 or by name: contact.0.penalty=10.
                        Can be given several times
  --output DIRECTORY    the same as --set 'output.directory="DIRECTORY"'; -o
                        is short for it. A run does not begin where another one left results
  --log WHAT:DATA       a table in logs/ like FEBio's log file: WHAT is nodes,
                        elements or rigid_bodies, DATA are names of FEBio such as
                        x;y;z;ux;Rx;p, sx;sxy;s1;Ex;Fxx;J;wx, or qx;Fx;Mx. Can be
                        given several times; output.log has more choices
  --overwrite           remove those, and begin; other files stay
  --resume              go on from the newest checkpoint in the output directory
                        that is good; begin at the start if there is none. Only
                        title, time, solver and output may have changed
  --restart FILE        go on from this checkpoint, whatever has changed that
                        keeps mesh, order and contact pairs; the log lists it.
                        What its output directory has of later times is removed
  --convert             only write MODEL.feb as a case and a mesh, to the output
                        directory; they give the same run and can be edited
  --dry-schema          list all keys of a case with types, defaults and units
  --help                print this
  --version             print the versions of synovia and what it uses
)";

const std::vector<std::string> option_names = {
   "--check",      "--set",    "--output",  "--log",
   "--overwrite",  "--resume", "--restart", "--convert",
   "--dry-schema", "--help",   "--version"};

struct Options
{
   std::string file;
   std::vector<std::string> overrides;
   std::string output;
   std::string restart;
   std::vector<LogDefinition> logs;
   bool convert = false;
   bool overwrite = false;
   bool resume = false;
   bool check = false;
   bool schema = false;
   bool help = false;
   bool version = false;
};

[[noreturn]] void Fail(const std::string &problem)
{
   throw Error(problem + "; --help lists the options");
}

/// What --log asks for, in a file that the others don't have.
LogDefinition ParseLog(const std::string &text,
                       const std::vector<LogDefinition> &others)
{
   const size_t colon = text.find(':');
   const std::string subject = text.substr(0, colon);
   LogDefinition log;
   const auto &words = LogSubjectWords();
   const auto found =
      std::find_if(words.begin(), words.end(),
                   [&](const auto &word) { return word.first == subject; });
   if (colon == std::string::npos || found == words.end())
   {
      Fail("--log takes nodes, elements or rigid_bodies, a colon, and names "
           "separated by semicolons, such as nodes:ux;uy;uz");
   }
   log.of = found->second;
   std::istringstream names(text.substr(colon + 1));
   for (std::string name; std::getline(names, name, ';');)
   {
      log.data.push_back(name);
   }
   const auto same = std::count_if(others.begin(), others.end(),
                                   [&](const LogDefinition &other)
                                   { return other.of == log.of; });
   log.file = "log_" + subject +
              (same == 0 ? "" : "_" + std::to_string(same + 1)) + ".txt";
   return log;
}

/// The arguments one by one, --option=value taken apart.
class Arguments
{
public:
   Arguments(int argc, char *argv[]) : words(argv + 1, argv + argc) {}

   bool Next(std::string &word)
   {
      if (at == words.size())
      {
         return false;
      }
      word = words[at++];
      const size_t equals = word.find('=');
      has_value = word.rfind("--", 0) == 0 && equals != std::string::npos;
      if (has_value)
      {
         value = word.substr(equals + 1);
         word.resize(equals);
      }
      return true;
   }

   /// What goes with the last word.
   std::string Value(const std::string &option)
   {
      if (has_value)
      {
         has_value = false;
         return value;
      }
      if (at == words.size())
      {
         Fail(option + " needs a value");
      }
      return words[at++];
   }

   /// For options that take none.
   void NoValue(const std::string &option) const
   {
      if (has_value)
      {
         Fail(option + " takes no value");
      }
   }

private:
   std::vector<std::string> words;
   size_t at = 0;
   bool has_value = false;
   std::string value;
};

Options Parse(int argc, char *argv[])
{
   Options options;
   Arguments arguments(argc, argv);
   std::string word;
   while (arguments.Next(word))
   {
      if (word == "--set")
      {
         options.overrides.push_back(arguments.Value(word));
         continue;
      }
      if (word == "--output" || word == "-o")
      {
         options.output = arguments.Value(word);
         options.overrides.push_back("output.directory=" +
                                     Quoted(options.output));
         continue;
      }
      if (word == "--log")
      {
         options.logs.push_back(ParseLog(arguments.Value(word), options.logs));
         continue;
      }
      if (word == "--restart")
      {
         options.restart = arguments.Value(word);
         continue;
      }
      arguments.NoValue(word);
      if (word == "--check")
      {
         options.check = true;
      }
      else if (word == "--convert")
      {
         options.convert = true;
      }
      else if (word == "--overwrite")
      {
         options.overwrite = true;
      }
      else if (word == "--resume")
      {
         options.resume = true;
      }
      else if (word == "--dry-schema")
      {
         options.schema = true;
      }
      else if (word == "--help" || word == "-h")
      {
         options.help = true;
      }
      else if (word == "--version")
      {
         options.version = true;
      }
      else if (!word.empty() && word[0] == '-')
      {
         const std::string guess = Suggest(word, option_names);
         Fail("there is no option " + word +
              (guess.empty() ? "" : "; did you mean " + guess + "?"));
      }
      else if (!options.file.empty())
      {
         Fail("two case files are given: " + options.file + " and " + word);
      }
      else
      {
         options.file = word;
      }
   }
   return options;
}

/// Writes a model of FEBio as a case, which the options name from then on.
void Convert(Options &options)
{
   const std::string name = std::filesystem::path(options.file).stem();
   const std::string directory = !options.output.empty() ? options.output
                                 : options.convert       ? name
                                                         : "out/" + name;
   options.file = ConvertFeb(options.file, directory, MPI_COMM_WORLD);
   options.overrides.insert(options.overrides.begin(),
                            "output.directory=" + Quoted(directory));
   if (options.convert && mfem::Mpi::Root())
   {
      std::cout << "wrote " << options.file << std::endl;
   }
}

/// Whether there was something to print and nothing else to do.
bool Print(const Options &options)
{
   if (options.help || options.version || options.schema)
   {
      if (mfem::Mpi::Root())
      {
         if (options.help)
         {
            std::cout << usage;
         }
         if (options.version)
         {
            for (const auto &[name, version] : Versions())
            {
               std::cout << name << ' ' << version << '\n';
            }
         }
         if (options.schema)
         {
            ListCaseKeys(std::cout);
         }
         std::cout << std::flush;
      }
      return true;
   }
   return false;
}

int Run(int argc, char *argv[])
{
   Options options = Parse(argc, argv);
   if (Print(options))
   {
      return 0;
   }
   if (options.file.empty())
   {
      Fail("no case file is given");
   }
   if (options.resume && !options.restart.empty())
   {
      Fail("--resume and --restart exclude each other");
   }
   if (options.resume && options.overwrite)
   {
      Fail("--resume and --overwrite exclude each other");
   }
   if (options.convert && !IsFebFile(options.file))
   {
      Fail(
         "--convert takes a model of FEBio, a file whose name ends with .feb");
   }
   if (IsFebFile(options.file))
   {
      Convert(options);
      if (options.convert)
      {
         return 0;
      }
   }
   CaseFile setup = ReadCase(options.file, MPI_COMM_WORLD, options.overrides);
   setup.output.logs.insert(setup.output.logs.end(), options.logs.begin(),
                            options.logs.end());
   Simulation simulation(setup, MPI_COMM_WORLD);
   if (options.check)
   {
      simulation.Describe(std::cout);
      return 0;
   }
   if (options.resume)
   {
      simulation.Resume();
   }
   else if (!options.restart.empty())
   {
      simulation.Restart(options.restart, options.overwrite);
   }
   else if (options.overwrite)
   {
      simulation.Overwrite();
   }
   return simulation.Run();
}

} // namespace

int main(int argc, char *argv[])
{
   mfem::Mpi::Init(argc, argv);
   mfem::Hypre::Init();
   return RunMain("synovia", Run, argc, argv);
}
