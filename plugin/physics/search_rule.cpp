#include "synovia/physics/search_rule.hpp"

#include <algorithm>

namespace synovia
{

using namespace mfem;

void SearchRule::AddResidual(real_t norm)
{
   last = std::max(last, norm);
}

bool SearchRule::AllowsEarly(real_t norm)
{
   const bool falls = norm < least;
   least = std::min(least, norm);
   return searches == 0 && falls &&
          early_searches++ < tuning.max_early_searches;
}

bool SearchRule::IsNear(real_t norm) const
{
   return norm <= tuning.search_accuracy * last;
}

bool SearchRule::Allows() const
{
   return searches < tuning.max_searches &&
          (searches == 0 || last < tuning.search_reduction * before_last);
}

void SearchRule::Restart()
{
   searches++;
   before_last = last;
   last = 0.0;
}

} // namespace synovia
