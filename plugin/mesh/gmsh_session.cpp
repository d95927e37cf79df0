#include "mesh/gmsh_session.hpp"

#include <gmsh.h>

namespace synovia
{

namespace
{
const char *const terminal = "General.Terminal";
const char *const abort_on_error = "General.AbortOnError";
} // namespace

GmshSession::GmshSession()
{
   // Where it has been done, it does nothing. Before it, no other function may
   // be called: gmsh 4.8 would report an error, and what it does upon errors,
   // such as to exit, is up to uninitialised memory then.
   gmsh::initialize(0, nullptr, false);
   gmsh::option::getNumber(terminal, callers_terminal);
   gmsh::option::getNumber(abort_on_error, callers_abort);
   gmsh::option::setNumber(terminal, 0.0);
   // gmsh lacks some functions of high order. It calls that an error, but gives
   // what it has.
   gmsh::option::setNumber(abort_on_error, 0.0);
}

GmshSession::~GmshSession()
{
   try
   {
      gmsh::option::setNumber(terminal, callers_terminal);
      gmsh::option::setNumber(abort_on_error, callers_abort);
   }
   catch (...)
   {
      // Nothing that was asked of gmsh is lost.
   }
}

} // namespace synovia
