#pragma once

#include "synovia/materials/material_frame.hpp"

#include <vector>

namespace synovia
{

/// Axes that are uniform in each element of this rank's mesh.
class ElementFrame : public MaterialFrame
{
public:
   Tensor3<> GetAxes(const MaterialPoint &point) const override
   {
      return axes[point.trans.ElementNo];
   }

protected:
   explicit ElementFrame(size_t elements) : axes(elements) {}

   bool HasAxes(const mfem::ElementTransformation &trans) const
   {
      return axes[trans.ElementNo][0][1] != 0.0 ||
             axes[trans.ElementNo][1][1] != 0.0 ||
             axes[trans.ElementNo][2][1] != 0.0;
   }

   /// Zero where there are none.
   std::vector<Tensor3<>> axes;
};

} // namespace synovia
