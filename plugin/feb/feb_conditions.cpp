#include "synovia/feb/feb_conditions.hpp"

#include <algorithm>
#include <iterator>

namespace synovia
{

using namespace mfem;

namespace
{
using Curve = std::optional<LoadCurve> BoundaryCase::*;

constexpr Curve loads[] = {
   &BoundaryCase::normal_traction, &BoundaryCase::effective_traction,
   &BoundaryCase::normal_flux, &BoundaryCase::mixture_flux};

// One of two prescribed values.
void Settle(std::optional<LoadCurve> &earlier, std::optional<LoadCurve> &later)
{
   if (earlier && later)
   {
      (later->IsZero() ? later : earlier).reset();
   }
}

// Moves what @a earlier says of the same to @a later, or the other way round.
void Merge(BoundaryCase &earlier, BoundaryCase &later)
{
   for (int d = 0; d < 3; d++)
   {
      Settle(earlier.displacement[d], later.displacement[d]);
   }
   Settle(earlier.pressure, later.pressure);
   for (const Curve load : loads)
   {
      if (earlier.*load && later.*load)
      {
         later.*load = Sum(*(earlier.*load), 1.0, *(later.*load));
         (earlier.*load).reset();
      }
   }
   if (earlier.traction && later.traction)
   {
      for (int d = 0; d < 3; d++)
      {
         (*later.traction)[d] =
            Sum((*earlier.traction)[d], 1.0, (*later.traction)[d]);
      }
      earlier.traction.reset();
   }
}

bool Draws(const BoundaryCase &condition, int component)
{
   return condition.traction && !(*condition.traction)[component].IsZero();
}

// Whether a case can't have both on one surface, in this order or the other.
bool Exclude(const BoundaryCase &a, const BoundaryCase &b)
{
   bool excluded = (a.pressure && (b.normal_flux || b.mixture_flux)) ||
                   (a.normal_flux && b.mixture_flux) ||
                   (a.normal_traction && b.effective_traction);
   for (int d = 0; d < 3; d++)
   {
      excluded = excluded || (a.displacement[d] && Draws(b, d));
   }
   return excluded;
}

// Whether both say something of the same.
bool AreAlike(const BoundaryCase &a, const BoundaryCase &b)
{
   bool alike = a.pressure && b.pressure;
   for (int d = 0; d < 3; d++)
   {
      alike = alike || (a.displacement[d] && b.displacement[d]) ||
              (Draws(a, d) && Draws(b, d));
   }
   return alike || std::any_of(std::begin(loads), std::end(loads),
                               [&](Curve load) { return a.*load && b.*load; });
}

bool IsEmpty(const BoundaryCase &condition)
{
   const auto &u = condition.displacement;
   return !u[0] && !u[1] && !u[2] && !condition.pressure &&
          !condition.traction && !condition.guide &&
          std::none_of(std::begin(loads), std::end(loads),
                       [&](Curve load)
                       { return (condition.*load).has_value(); });
}

// Whether it prescribes displacements or pressures.
bool Prescribes(const BoundaryCase &condition)
{
   const auto &u = condition.displacement;
   return u[0] || u[1] || u[2] || condition.pressure;
}

// Whether it prescribes nothing else than zeros.
bool IsZero(const BoundaryCase &condition)
{
   const auto is_zero = [](const std::optional<LoadCurve> &value)
   { return !value || value->IsZero(); };
   return std::all_of(condition.displacement.begin(),
                      condition.displacement.end(), is_zero) &&
          is_zero(condition.pressure);
}
} // namespace

void AddCondition(BoundaryCase condition, const FebInput &where,
                  FebModel &model)
{
   std::vector<BoundaryCase> &all = model.setup.boundaries;
   for (size_t i = 0; i < all.size(); i++)
   {
      BoundaryCase &other = all[i];
      if (other.surfaces != condition.surfaces)
      {
         continue;
      }
      const std::string &surface = other.surfaces[0];
      if (Exclude(other, condition) || Exclude(condition, other))
      {
         where.Stop("\"" + surface +
                    "\" has a condition that excludes this one here: a "
                    "pressure and a flux, a displacement and a load along it, "
                    "or two kinds of a load");
         return;
      }
      if (i >= model.first_condition)
      {
         Merge(other, condition);
      }
      else if (AreAlike(other, condition))
      {
         where.Stop("\"" + surface +
                    "\" has such a condition in all steps already; one that "
                    "adds to it in a step is not known");
         return;
      }
   }
   all.push_back(std::move(condition));
   all.erase(
      std::remove_if(all.begin() + static_cast<long>(model.first_condition),
                     all.end(), IsEmpty),
      all.end());
}

void PutZerosFirst(FebModel &model)
{
   std::vector<BoundaryCase> &all = model.setup.boundaries;
   const auto first = all.begin() + static_cast<long>(model.first_condition);
   std::vector<BoundaryCase> sorted;
   std::copy_if(first, all.end(), std::back_inserter(sorted), Prescribes);
   std::stable_partition(sorted.begin(), sorted.end(), IsZero);
   auto next = sorted.begin();
   for (auto place = first; place != all.end(); ++place)
   {
      if (Prescribes(*place))
      {
         *place = *next++;
      }
   }
}

} // namespace synovia
