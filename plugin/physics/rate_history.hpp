#pragma once

#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/general/state_archive.hpp"

#include <array>

namespace synovia
{

/// Rates (v, dp/dt) of the last two stages, and the rate of the next one as it
/// may be expected from them: the last, or where a line through both would have
/// come closer to the last, the line's. Corners of loads are no lines.
class RateHistory
{
public:
   /// Borrows @a spaces_. Begins without rates.
   explicit RateHistory(BiphasicSpaces &spaces_);

   /// Rate of the last stage, zero without any.
   const mfem::Vector &Last() const { return last; }
   /// Length of the last stage (time).
   mfem::real_t LastLength() const { return last_length; }
   /// Rate of displacement and pressure, true dofs, that a stage of @a time may
   /// be expected to have.
   mfem::Vector Expected(mfem::real_t time) const;
   /// Adds the @a rate of a stage of this @a time and length @a dt, true dofs
   /// of displacement and pressure; what may follow them isn't kept.
   /// Collective.
   void Add(mfem::real_t time, mfem::real_t dt, const mfem::Vector &rate);
   /// As at the beginning.
   void Forget();
   void Archive(StateArchive &archive);

private:
   /// Rate at @a time on the line through the last two.
   mfem::Vector OnLine(mfem::real_t time) const;
   /// Whether there is such a line, and it isn't to be followed too far.
   bool Reaches(mfem::real_t time) const;

   BiphasicSpaces *spaces;
   /// Of displacement and pressure, true dofs.
   mfem::Vector last;
   mfem::real_t last_time = 0.0;
   mfem::real_t last_length = 0.0;
   /// The same of the stage before.
   mfem::Vector before;
   mfem::real_t before_time = 0.0;
   /// How many there are of both.
   int stages = 0;
   /// Whether the line through the two stages before the last came closer.
   bool is_smooth = false;
};

} // namespace synovia
