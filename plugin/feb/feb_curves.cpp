#include "synovia/feb/feb_curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace synovia
{

using namespace mfem;

namespace
{
// Relative to the end of the run.
constexpr real_t same_time = 1e-9;

// The parabola through three points.
real_t Parabola(const real_t *t, const real_t *y, real_t at)
{
   real_t sum = 0.0;
   for (int i = 0; i < 3; i++)
   {
      const int j = (i + 1) % 3;
      const int k = (i + 2) % 3;
      sum += y[i] * (at - t[j]) * (at - t[k]) / ((t[i] - t[j]) * (t[i] - t[k]));
   }
   return sum;
}

real_t Line(real_t t0, real_t y0, real_t t1, real_t y1, real_t at)
{
   const real_t s = (at - t0) / (t1 - t0);
   return (1.0 - s) * y0 + s * y1;
}
} // namespace

FebCurve::FebCurve(std::vector<real_t> times_, std::vector<real_t> values_,
                   Between between_, Beyond beyond_)
   : times(std::move(times_)), values(std::move(values_)), between(between_),
     beyond(beyond_)
{
}

real_t FebCurve::operator()(real_t t) const
{
   if (times.size() == 1)
   {
      return values[0];
   }
   const real_t first = times.front();
   const real_t last = times.back();
   if (t >= first && t <= last)
   {
      return Inside(t);
   }
   const size_t n = times.size();
   switch (beyond)
   {
   case Beyond::extrapolate:
      return t < first ? Line(times[0], values[0], times[1], values[1], t)
                       : Line(times[n - 2], values[n - 2], times[n - 1],
                              values[n - 1], t);
   case Beyond::repeat:
   {
      const real_t period = last - first;
      return Inside(t - period * std::floor((t - first) / period));
   }
   default:
      return t < first ? values.front() : values.back();
   }
}

real_t FebCurve::Inside(real_t t) const
{
   const auto at = std::lower_bound(times.begin(), times.end(), t);
   const size_t next = at - times.begin();
   if (next == 0 || *at == t)
   {
      return values[next];
   }
   const size_t n = times.size();
   if (between == Between::step)
   {
      return values[next];
   }
   if (between == Between::linear || n == 2)
   {
      return Line(times[next - 1], values[next - 1], times[next], values[next],
                  t);
   }
   const auto through = [&](size_t first)
   { return Parabola(&times[first], &values[first], t); };
   if (next == 1)
   {
      return through(0);
   }
   if (next == n - 1)
   {
      return through(n - 3);
   }
   return Line(times[next - 1], through(next - 2), times[next],
               through(next - 1), t);
}

LoadCurve FebCurve::ForSteps(const std::vector<real_t> &ends,
                             real_t factor) const
{
   const real_t near = same_time * ends.back();
   const auto is_end = [&](real_t t)
   {
      const auto next = std::lower_bound(ends.begin(), ends.end(), t - near);
      return t <= near || t >= ends.back() - near ||
             (next != ends.end() && *next <= t + near);
   };
   std::vector<real_t> corners(times);
   const bool straight = between == Between::linear || times.size() == 2;
   if (between == Between::step || !straight || beyond != Beyond::constant ||
       !std::all_of(corners.begin(), corners.end(), is_end))
   {
      corners.assign(1, 0.0);
      corners.insert(corners.end(), ends.begin(), ends.end());
   }
   std::vector<real_t> numbers;
   for (const real_t t : corners)
   {
      numbers.push_back(factor * (*this)(t));
   }
   // What holds from the first step on holds from the start.
   if (corners.size() > 1 && corners.front() == 0.0 &&
       std::all_of(numbers.begin() + 1, numbers.end(),
                   [&](real_t y) { return y == numbers.back(); }) &&
       between == Between::step)
   {
      return LoadCurve(numbers.back());
   }
   return corners.size() == 1 ? LoadCurve(numbers[0])
                              : LoadCurve(corners, numbers);
}

LoadCurve Sum(const LoadCurve &a, real_t factor, const LoadCurve &b)
{
   std::set<real_t> times(a.Corners().begin(), a.Corners().end());
   times.insert(b.Corners().begin(), b.Corners().end());
   std::vector<real_t> values;
   for (const real_t t : times)
   {
      values.push_back(a(t) + factor * b(t));
   }
   return LoadCurve({times.begin(), times.end()}, values);
}

namespace
{
template <typename Word>
Word Choose(const FebInput &controller, const std::string &child,
            const std::vector<std::pair<std::string, Word>> &words)
{
   const std::optional<FebInput> found = controller.Find(child);
   if (!found)
   {
      return words.front().second;
   }
   std::string known;
   for (const auto &[word, value] : words)
   {
      if (word == found->Text())
      {
         return value;
      }
      known += (known.empty() ? "" : ", ") + word;
   }
   found->Stop("found \"" + found->Text() + "\"; there are " + known);
   return words.front().second;
}

// <points><pt>t,y</pt>, or before version 4.0 points at the top.
void ReadPoints(const FebInput &controller, std::vector<real_t> &times,
                std::vector<real_t> &values)
{
   const std::optional<FebInput> group = controller.Find("points");
   const FebInput &from = group ? *group : controller;
   std::vector<FebInput> points = from.All("pt");
   for (const FebInput &point : from.All("point"))
   {
      points.push_back(point);
   }
   for (const FebInput &point : points)
   {
      const std::vector<real_t> pair = point.Numbers();
      if (pair.size() != 2)
      {
         point.Stop("a point has a time and a value");
      }
      else if (!times.empty() && pair[0] <= times.back())
      {
         point.Stop("the times of a curve must ascend");
      }
      else
      {
         times.push_back(pair[0]);
         values.push_back(pair[1]);
      }
   }
   if (points.empty())
   {
      controller.Stop("the curve has no points");
   }
}
} // namespace

FebCurves ReadLoadData(const FebInput &section)
{
   using Between = FebCurve::Between;
   using Beyond = FebCurve::Beyond;
   FebCurves curves;
   std::vector<FebInput> controllers = section.All("load_controller");
   for (const FebInput &former : section.All("loadcurve"))
   {
      controllers.push_back(former);
   }
   for (const FebInput &controller : controllers)
   {
      const std::string number = controller.NeededAttribute("id");
      controller.Attribute("name");
      const std::string type = controller.Attribute("type");
      if (controller.Name() == "load_controller" && type != "loadcurve")
      {
         controller.StopAll("controllers of the type \"" + type +
                            "\" are not known; there is loadcurve");
         continue;
      }
      // Version 2.5 has the kind of curve here, linear by default.
      const std::vector<std::pair<std::string, Between>> kinds{
         {"LINEAR", Between::linear}, {"STEP", Between::step},
         {"SMOOTH", Between::smooth}, {"linear", Between::linear},
         {"step", Between::step},     {"smooth", Between::smooth}};
      const std::vector<std::pair<std::string, Beyond>> ends{
         {"CONSTANT", Beyond::constant},
         {"EXTRAPOLATE", Beyond::extrapolate},
         {"REPEAT", Beyond::repeat}};
      Between between = Choose(controller, "interpolate", kinds);
      if (controller.Name() == "loadcurve")
      {
         for (const auto &[word, kind] : kinds)
         {
            between = word == type ? kind : between;
         }
      }
      const Beyond beyond = Choose(controller, "extend", ends);
      std::vector<real_t> times;
      std::vector<real_t> values;
      ReadPoints(controller, times, values);
      if (!times.empty() &&
          !curves.emplace(number, FebCurve(times, values, between, beyond))
              .second)
      {
         controller.Stop("there are two controllers with the number " + number);
      }
   }
   return curves;
}

const FebCurve *FindCurve(const FebInput &value, const FebCurves &curves)
{
   if (!value.HasAttribute("lc"))
   {
      return nullptr;
   }
   const std::string number = value.Attribute("lc");
   const auto found = curves.find(number);
   if (found == curves.end())
   {
      value.Stop("there is no load controller " + number);
      return nullptr;
   }
   return &found->second;
}

} // namespace synovia
