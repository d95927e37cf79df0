#pragma once

#include "synovia/feb/feb_input.hpp"
#include "synovia/general/load_curve.hpp"

#include <map>
#include <string>
#include <vector>

namespace synovia
{

/// A load curve of FEBio, which is a function of time by its points.
class FebCurve
{
public:
   enum class Between
   {
      linear,
      /// The value of the next point.
      step,
      /// Through parabolas.
      smooth
   };
   enum class Beyond
   {
      constant,
      extrapolate,
      repeat
   };

   /// The points' times ascend.
   FebCurve(std::vector<mfem::real_t> times, std::vector<mfem::real_t> values,
            Between between, Beyond beyond);

   mfem::real_t operator()(mfem::real_t t) const;
   const std::vector<mfem::real_t> &Times() const { return times; }
   bool Repeats() const { return beyond == Beyond::repeat; }

   /// As a curve of a case, linear between the points: the same values at the
   /// ends of the steps, which ascend from above 0.
   LoadCurve ForSteps(const std::vector<mfem::real_t> &ends,
                      mfem::real_t factor) const;

private:
   mfem::real_t Inside(mfem::real_t t) const;

   std::vector<mfem::real_t> times;
   std::vector<mfem::real_t> values;
   Between between;
   Beyond beyond;
};

/// @a a plus @a factor times @a b, at all times of both.
LoadCurve Sum(const LoadCurve &a, mfem::real_t factor, const LoadCurve &b);

/// Load controllers by their numbers.
using FebCurves = std::map<std::string, FebCurve>;

/// Reads the section LoadData.
FebCurves ReadLoadData(const FebInput &section);

/// The curve that the attribute lc of @a value names, or null if it names none.
const FebCurve *FindCurve(const FebInput &value, const FebCurves &curves);

} // namespace synovia
