#include "synovia/feb/feb_model.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
LoadCurve Negative(const LoadCurve &curve)
{
   std::vector<real_t> values;
   for (const real_t t : curve.Corners())
   {
      values.push_back(-curve(t));
   }
   return LoadCurve(curve.Corners(), values);
}

// A tension along the normal, which follows it.
void ReadNormalTraction(const FebInput &load, BoundaryCase &boundary,
                        const FebModel &model)
{
   load.Expect("linear", false,
               "loads on the undeformed surface that keep their direction are "
               "not known for normal tractions");
   boundary.normal_traction = model.Value(load, "traction");
   load.Expect("effective", false,
               "effective tractions, to which the fluid's pressure adds, are "
               "not known");
}

void ReadPressure(const FebInput &load, BoundaryCase &boundary,
                  const FebModel &model)
{
   load.Expect("linear", false,
               "pressures on the undeformed surface are not known");
   load.Ignore("symmetric_stiffness", "the tangent is complete");
   boundary.normal_traction = Negative(model.Value(load, "pressure"));
}

void ReadFluidFlux(const FebInput &load, BoundaryCase &boundary,
                   const FebModel &model)
{
   load.Expect("linear", false,
               "fluxes through the undeformed surface are not known");
   load.Expect("mixture", false, "fluxes of the whole mixture are not known");
   boundary.normal_flux = model.Value(load, "flux");
}

void ReadTraction(const FebInput &load, BoundaryCase &boundary,
                  const FebModel &model)
{
   const std::optional<FebInput> vector = load.Find("traction");
   const std::optional<FebInput> scale = load.Find("scale");
   const std::vector<real_t> components =
      vector ? vector->Numbers() : std::vector<real_t>();
   if (components.size() != 3)
   {
      load.Stop("<traction> must have three components");
      return;
   }
   const LoadCurve curve = scale ? model.Value(*scale) : LoadCurve(1.0);
   boundary.traction = std::array<LoadCurve, 3>{{0.0, 0.0, 0.0}};
   for (int d = 0; d < 3; d++)
   {
      std::vector<real_t> values;
      for (const real_t t : curve.Corners())
      {
         values.push_back(components[d] * curve(t));
      }
      (*boundary.traction)[d] = LoadCurve(curve.Corners(), values);
   }
   if (!load.Flag("linear", false))
   {
      load.Approximate("the traction is per undeformed area, not per deformed "
                       "area");
   }
}

void ReadSurfaceLoad(const FebInput &load, FebModel &model)
{
   using Reader = void (*)(const FebInput &, BoundaryCase &, const FebModel &);
   const std::map<std::string, Reader> readers{
      {"normal_traction", ReadNormalTraction},
      {"pressure", ReadPressure},
      {"fluidflux", ReadFluidFlux},
      {"traction", ReadTraction}};
   load.Attribute("name");
   const std::string type = load.NeededAttribute("type");
   const auto reader = readers.find(type);
   if (reader == readers.end())
   {
      load.StopAll("loads of the type \"" + type +
                   "\" are not known; there are fluidflux, normal_traction, "
                   "pressure, traction");
      return;
   }
   load.Expect("shell_bottom", false, "only rigid shells are read");
   BoundaryCase boundary;
   boundary.surfaces = {
      model.surfaces->OfFacets(load.NeededAttribute("surface"), load)};
   reader->second(load, boundary, model);
   if (!boundary.surfaces[0].empty())
   {
      model.setup.boundaries.push_back(boundary);
   }
}
} // namespace

void ReadLoads(const FebInput &section, FebModel &model)
{
   for (const FebInput &load : section.All("surface_load"))
   {
      ReadSurfaceLoad(load, model);
   }
}

} // namespace synovia
