#pragma once

namespace synovia
{

/// Lends gmsh's library, silent, for a lifetime.
///
/// A program that uses gmsh itself finds it as it was: initialised or not, with
/// its model and options. Only one session at a time.
class GmshSession
{
public:
   GmshSession();
   ~GmshSession();
   GmshSession(const GmshSession &) = delete;
   GmshSession &operator=(const GmshSession &) = delete;

private:
   bool was_initialised;
   double callers_terminal = 0.0;
   double callers_abort = 0.0;
};

} // namespace synovia
