#pragma once

namespace synovia
{

/// Lends gmsh's library, silent, for a lifetime.
///
/// Initialises gmsh if need be, and leaves it so: gmsh can't be asked whether
/// it is initialised, and finalising would end the session of a program that
/// uses gmsh itself. Such a program finds its model and options as they were.
/// Only one session at a time.
class GmshSession
{
public:
   GmshSession();
   ~GmshSession();
   GmshSession(const GmshSession &) = delete;
   GmshSession &operator=(const GmshSession &) = delete;

private:
   double callers_terminal = 0.0;
   double callers_abort = 0.0;
};

} // namespace synovia
