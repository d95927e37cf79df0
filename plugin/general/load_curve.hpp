#pragma once

#include "mfem.hpp"

#include <vector>

namespace synovia
{

/// A scalar function of time: constant, or linear between points and constant
/// before the first and after the last.
class LoadCurve
{
public:
   /// The constant @a value.
   LoadCurve(mfem::real_t value) : times{0.0}, values{value} {}

   /// Linear between the points. Throws Error unless the times ascend strictly
   /// and there are as many values as times, at least one, all finite.
   LoadCurve(std::vector<mfem::real_t> times, std::vector<mfem::real_t> values);

   mfem::real_t operator()(mfem::real_t t) const;
   /// Whether it is zero at all times.
   bool IsZero() const;

   /// The same @a number times, one after the other. If that is more than once,
   /// throws Error where it does not end with the value that it begins with, or
   /// has one point only.
   LoadCurve Repeated(int number) const;
   /// The same, later by @a delay.
   LoadCurve Delayed(mfem::real_t delay) const;

   /// Times at which the slope may jump: a time step should end there.
   const std::vector<mfem::real_t> &Corners() const { return times; }

private:
   std::vector<mfem::real_t> times;
   std::vector<mfem::real_t> values;
};

/// From 0 at t = 0 to @a value at @a duration, then held.
LoadCurve Ramp(mfem::real_t duration, mfem::real_t value);

} // namespace synovia
