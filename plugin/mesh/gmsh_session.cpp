#include "mesh/gmsh_session.hpp"

#include <gmsh.h>

namespace synovia
{

namespace
{

// Older versions of gmsh do not tell, but do not give options before they are
// initialised: they leave the value alone, or throw if they have been
// finalised.
bool GmshIsInitialised()
{
   double verbosity = -1.0;
   try
   {
      gmsh::option::getNumber("General.Verbosity", verbosity);
   }
   catch (...)
   {
      return false;
   }
   return verbosity >= 0.0;
}

const char *const terminal = "General.Terminal";
const char *const abort_on_error = "General.AbortOnError";

} // namespace

GmshSession::GmshSession() : was_initialised(GmshIsInitialised())
{
   if (was_initialised)
   {
      gmsh::option::getNumber(terminal, callers_terminal);
      gmsh::option::getNumber(abort_on_error, callers_abort);
   }
   else
   {
      gmsh::initialize(0, nullptr, false);
   }
   gmsh::option::setNumber(terminal, 0.0);
   // gmsh lacks some functions of high order. It calls that an error, but gives
   // what it has.
   gmsh::option::setNumber(abort_on_error, 0.0);
}

GmshSession::~GmshSession()
{
   try
   {
      // Options outlive gmsh: what is left here keeps GmshIsInitialised()
      // quiet.
      gmsh::option::setNumber(terminal, callers_terminal);
      gmsh::option::setNumber(abort_on_error, callers_abort);
      if (!was_initialised)
      {
         gmsh::finalize();
      }
   }
   catch (...)
   {
      // Nothing that was asked of gmsh is lost.
   }
}

} // namespace synovia
