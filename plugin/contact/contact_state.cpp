#include "synovia/contact/contact_state.hpp"
#include "synovia/general/reduce.hpp"

namespace synovia
{

using namespace mfem;

ContactState::ContactState(int size, bool rubs_)
   : vertices(size), rubs(rubs_), friction(rubs ? size : 0)
{
   for (Vector *v :
        {&multiplier, &flux_multiplier, &gap, &jump, &pressure, &traction,
         &flux, &gap_weights, &jump_weights, &history.traction[0],
         &history.traction[1], &history.flux[0], &history.flux[1]})
   {
      v->SetSize(size);
      *v = 0.0;
   }
}

Vector ContactState::Touching() const
{
   Vector result(gap.Size());
   for (int j = 0; j < result.Size(); j++)
   {
      result[j] = vertices[j].touches ? 1.0 : 0.0;
   }
   return result;
}

Vector ContactState::Sealing() const
{
   Vector result(gap.Size());
   for (int j = 0; j < result.Size(); j++)
   {
      result[j] = vertices[j].seals ? 1.0 : 0.0;
   }
   return result;
}

void ContactState::Archive(StateArchive &archive, const std::string &prefix,
                           const ContactSurface &destination)
{
   const auto field = [&](const std::string &name, Vector &values)
   { destination.Archive(archive, prefix + name, values); };
   const char *times[2] = {"before_last.", "last."};
   for (int i = 0; i < 2; i++)
   {
      archive.Number(prefix + times[i] + "time", history.time[i]);
      field(times[i] + std::string("traction"), history.traction[i]);
      field(times[i] + std::string("flux"), history.flux[i]);
   }
   Vector active = Touching();
   Vector sealing = Sealing();
   field("multiplier", multiplier);
   field("flux_multiplier", flux_multiplier);
   field("gap", gap);
   field("jump", jump);
   field("traction", traction);
   field("flux", flux);
   field("active", active);
   field("sealing", sealing);
   field("gap_weights", gap_weights);
   field("jump_weights", jump_weights);
   for (size_t j = 0; j < vertices.size(); j++)
   {
      vertices[j].touches = active[j] > 0.5;
      vertices[j].seals = sealing[j] > 0.5;
   }
   if (rubs)
   {
      friction.Archive(archive, prefix + "friction.", destination);
   }
   archive.Number(prefix + "gap_stiffening", stiffening.gap);
   archive.Number(prefix + "jump_stiffening", stiffening.jump);
   touched = AnyRank(touched, destination.Spaces().GetComm());
   archive.Flag(prefix + "touched", touched);
}

} // namespace synovia
