#include "synovia/contact/tie_state.hpp"

namespace synovia
{

using namespace mfem;

TieMultipliers::TieMultipliers(int vertices)
{
   for (Vector *values : {&traction[0], &traction[1], &traction[2], &flux})
   {
      values->SetSize(vertices);
      *values = 0.0;
   }
}

void TieMultipliers::Add(real_t share, const TieMultipliers &other)
{
   for (int c = 0; c < 3; c++)
   {
      traction[c].Add(share, other.traction[c]);
   }
   flux.Add(share, other.flux);
}

void TieMultipliers::Archive(StateArchive &archive, const std::string &prefix,
                             const ContactSurface &destination)
{
   const char *const axes[3] = {"x", "y", "z"};
   for (int c = 0; c < 3; c++)
   {
      destination.Archive(archive, prefix + "traction_" + axes[c], traction[c]);
   }
   destination.Archive(archive, prefix + "flux", flux);
}

TieState::TieState(int vertices)
   : multiplier(vertices), acting(vertices),
     pressure_jump(vertices), past{{TieMultipliers(vertices),
                                    TieMultipliers(vertices)}}
{
   for (Vector &component : jump)
   {
      component.SetSize(vertices);
      component = 0.0;
   }
   pressure_jump = 0.0;
}

void TieState::Store(real_t time)
{
   multiplier = acting;
   times = {times[1], time};
   past[0] = past[1];
   past[1] = multiplier;
}

void TieState::Predict(real_t time, real_t reach)
{
   const real_t interval = times[1] - times[0];
   const real_t ahead = time - times[1];
   const real_t share =
      interval > 0.0 && ahead <= reach * interval ? ahead / interval : 0.0;
   multiplier = past[1];
   multiplier.Add(share, past[1]);
   multiplier.Add(-share, past[0]);
}

void TieState::Archive(StateArchive &archive, const std::string &prefix,
                       const ContactSurface &destination)
{
   const char *const names[2] = {"before_last.", "last."};
   for (int i = 0; i < 2; i++)
   {
      archive.Number(prefix + names[i] + "time", times[i]);
      past[i].Archive(archive, prefix + names[i], destination);
   }
   multiplier.Archive(archive, prefix, destination);
   archive.Number(prefix + "stiffening", stiffening.gap);
   archive.Number(prefix + "pressure_stiffening", stiffening.jump);
   if (archive.Reads())
   {
      acting = multiplier;
   }
}

} // namespace synovia
