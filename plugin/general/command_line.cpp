#include "synovia/general/command_line.hpp"
#include "synovia/general/error.hpp"

#include <iostream>
#include <sstream>

namespace synovia
{

using namespace mfem;

bool ParseCommandLine(OptionsParser &args)
{
   args.Parse();
   if (args.Help())
   {
      if (Mpi::Root())
      {
         args.PrintHelp(std::cout);
      }
      return false;
   }
   if (!args.Good())
   {
      std::ostringstream problem;
      args.PrintError(problem);
      std::string text = problem.str();
      text.erase(0, text.find_first_not_of(" \n"));
      text.erase(text.find_last_not_of(" \n") + 1);
      throw Error(text + "; --help lists the options");
   }
   return true;
}

} // namespace synovia
