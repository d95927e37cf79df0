#include "synovia/general/load_curve.hpp"
#include "synovia/general/error.hpp"

#include <algorithm>
#include <cmath>

namespace synovia
{

using namespace mfem;

LoadCurve::LoadCurve(std::vector<real_t> times_, std::vector<real_t> values_)
   : times(std::move(times_)), values(std::move(values_))
{
   if (times.empty() || times.size() != values.size())
   {
      throw Error("a load curve has " + std::to_string(times.size()) +
                  " times and " + std::to_string(values.size()) +
                  " values; give as many values as times, at least one");
   }
   const auto finite = [](real_t x) { return std::isfinite(x); };
   if (!std::all_of(times.begin(), times.end(), finite) ||
       !std::all_of(values.begin(), values.end(), finite))
   {
      throw Error("a load curve has a time or a value that is not finite");
   }
   for (size_t i = 1; i < times.size(); i++)
   {
      if (times[i] <= times[i - 1])
      {
         throw Error("the times of a load curve must ascend: " +
                     std::to_string(times[i]) + " follows " +
                     std::to_string(times[i - 1]));
      }
   }
}

real_t LoadCurve::operator()(real_t t) const
{
   if (t <= times.front())
   {
      return values.front();
   }
   if (t >= times.back())
   {
      return values.back();
   }
   const auto next = std::upper_bound(times.begin(), times.end(), t);
   const size_t i = next - times.begin();
   const real_t s = (t - times[i - 1]) / (times[i] - times[i - 1]);
   return (1.0 - s) * values[i - 1] + s * values[i];
}

bool LoadCurve::IsZero() const
{
   return std::all_of(values.begin(), values.end(),
                      [](real_t value) { return value == 0.0; });
}

LoadCurve LoadCurve::Repeated(int number) const
{
   if (number > 1 && (times.size() < 2 || values.front() != values.back()))
   {
      throw Error(
         "a load curve that repeats must have two points at least, and "
         "end with the value that it begins with");
   }
   LoadCurve all(*this);
   const real_t period = times.back() - times.front();
   for (int i = 1; i < number; i++)
   {
      for (std::size_t k = 1; k < times.size(); k++)
      {
         all.times.push_back(times[k] + i * period);
         all.values.push_back(values[k]);
      }
   }
   return all;
}

LoadCurve LoadCurve::Delayed(real_t delay) const
{
   LoadCurve later(*this);
   for (real_t &time : later.times)
   {
      time += delay;
   }
   return later;
}

LoadCurve Ramp(real_t duration, real_t value)
{
   return LoadCurve({0.0, duration}, {0.0, value});
}

} // namespace synovia
