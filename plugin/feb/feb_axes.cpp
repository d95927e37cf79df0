#include "synovia/feb/feb_axes.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr real_t degree = 0.017453292519943295;

Point3 ReadVector(const FebInput &from)
{
   const std::vector<real_t> x = from.Numbers();
   if (x.size() != 3)
   {
      from.Stop("a vector has three components");
      return {1.0, 0.0, 0.0};
   }
   return {x[0], x[1], x[2]};
}

Point3 ReadVector(const FebInput &from, const std::string &child,
                  const Point3 &standard)
{
   const std::optional<FebInput> found = from.Find(child);
   return found ? ReadVector(*found) : standard;
}

// The vector of length 1, or the first axis and an error.
Point3 Direction(const Point3 &vector, const FebInput &where)
{
   const real_t length = Length(vector);
   if (!(length > 0.0))
   {
      where.Stop("the direction is zero");
      return {1.0, 0.0, 0.0};
   }
   return {vector[0] / length, vector[1] / length, vector[2] / length};
}

// theta from the first axis towards the second, phi from the third, in degrees.
Point3 FromAngles(const FebInput &from)
{
   const real_t theta = degree * from.Number("theta", 0.0);
   const real_t phi = degree * from.Number("phi", 90.0);
   return {std::cos(theta) * std::sin(phi), std::sin(theta) * std::sin(phi),
           std::cos(phi)};
}
} // namespace

Tensor3<> ReadAxes(const FebInput &material)
{
   Tensor3<> axes{};
   for (int i = 0; i < 3; i++)
   {
      axes[i][i] = 1.0;
   }
   const std::optional<FebInput> from = material.Find("mat_axis");
   if (!from)
   {
      return axes;
   }
   const std::string type = from->NeededAttribute("type");
   if (type != "vector")
   {
      from->Stop("material axes of the type \"" + type +
                 "\" are not known; there is vector");
      return axes;
   }
   const Point3 first =
      Direction(ReadVector(*from, "a", {1.0, 0.0, 0.0}), *from);
   const Point3 third =
      Direction(Cross(first, ReadVector(*from, "d", {0.0, 1.0, 0.0})), *from);
   const Point3 second = Cross(third, first);
   for (int i = 0; i < 3; i++)
   {
      axes[i][0] = first[i];
      axes[i][1] = second[i];
      axes[i][2] = third[i];
   }
   return axes;
}

Point3 ReadFiber(const FebInput &law)
{
   const std::optional<FebInput> from = law.Find("fiber");
   if (!from)
   {
      return {1.0, 0.0, 0.0};
   }
   const std::string type = from->NeededAttribute("type");
   if (type == "angles")
   {
      return FromAngles(*from);
   }
   if (type == "vector")
   {
      const std::optional<FebInput> inner = from->Find("vector");
      return Direction(ReadVector(inner ? *inner : *from), *from);
   }
   from->Stop("fibers of the type \"" + type +
              "\" are not known; there are angles and vector");
   return {1.0, 0.0, 0.0};
}

} // namespace synovia
