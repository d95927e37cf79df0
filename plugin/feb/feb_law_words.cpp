#include "synovia/feb/feb_law_words.hpp"
#include "synovia/general/error.hpp"
#include "synovia/materials/material_frame.hpp"

#include <cmath>

namespace synovia
{

using namespace mfem;

namespace
{
constexpr real_t same_direction = 1e-12;
} // namespace

const LawWords *FindLaw(const FebInput &from,
                        const std::vector<LawWords> &words,
                        const std::string &also)
{
   const std::string type = from.NeededAttribute("type");
   std::string known = also;
   for (const LawWords &law : words)
   {
      if (law.feb == type)
      {
         return &law;
      }
      known += (known.empty() ? "" : ", ") + law.feb;
   }
   from.StopAll("\"" + type + "\" is not known; there are " + known);
   return nullptr;
}

std::map<std::string, real_t> ReadParameters(const FebInput &from,
                                             const LawWords &words,
                                             const LawDescription &law)
{
   std::map<std::string, real_t> values;
   for (const auto &[feb, name] : words.parameters)
   {
      const LawParameter &parameter = *law.Find(name);
      const std::optional<FebInput> found = from.Find(feb);
      if (!found)
      {
         if (!parameter.standard)
         {
            from.Stop("<" + feb + "> is missing");
         }
         continue;
      }
      const std::optional<real_t> value = found->FindNumber();
      if (!value)
      {
         continue;
      }
      try
      {
         parameter.Verify(*value);
         values[name] = *value;
      }
      catch (const Error &error)
      {
         found->Stop(error.what());
      }
   }
   return values;
}

Point3 InFrame(const Point3 &vector, const FrameCase &frame)
{
   const Tensor3<> axes = AxesAlong(frame.axis);
   Point3 components{};
   for (int i = 0; i < 3; i++)
   {
      for (int j = 0; j < 3; j++)
      {
         components[i] += axes[j][i] * vector[j];
      }
   }
   return components;
}

std::array<int, 3> FindAxes(const FebInput &from, const Tensor3<> &axes,
                            const FrameCase &frame)
{
   std::array<int, 3> places{{0, 1, 2}};
   for (int a = 0; a < 3; a++)
   {
      const Point3 parts = InFrame({axes[0][a], axes[1][a], axes[2][a]}, frame);
      bool found = false;
      for (int b = 0; b < 3; b++)
      {
         if (std::abs(std::abs(parts[b]) - 1.0) < same_direction)
         {
            places[a] = b;
            found = true;
         }
      }
      if (!found)
      {
         from.Stop("the second and third material axis must be along axes of "
                   "space");
         return {{0, 1, 2}};
      }
   }
   return places;
}

} // namespace synovia
