#include "synovia/feb/feb_conditions.hpp"

namespace synovia
{

using namespace mfem;

namespace
{
// Relative to the largest.
constexpr real_t same_area = 1e-6;

LoadCurve Scaled(real_t factor, const LoadCurve &curve)
{
   std::vector<real_t> values;
   for (const real_t t : curve.Corners())
   {
      values.push_back(factor * curve(t));
   }
   return LoadCurve(curve.Corners(), values);
}

// The prescribed fluid pressure of all nodes of a surface; null if there is
// none.
const LoadCurve *FindPressure(const std::string &surface, const FebModel &model)
{
   const std::vector<int> *nodes =
      model.surfaces->FindNodes("@surface:" + surface);
   for (const auto &[with, pressure] : model.pressures)
   {
      const std::set<int> &have = with;
      if (nodes && std::all_of(nodes->begin(), nodes->end(),
                               [&](int node) { return have.count(node) > 0; }))
      {
         return &pressure;
      }
   }
   return nullptr;
}

// A tension along the normal, which follows it.
void ReadNormalTraction(const FebInput &load, BoundaryCase &boundary,
                        const FebModel &model)
{
   load.Expect("linear", false,
               "loads on the undeformed surface that keep their direction are "
               "not known for normal tractions");
   boundary.normal_traction = model.Value(load, "traction");
   if (load.Flag("effective", false))
   {
      // The fluid's pressure adds.
      const LoadCurve *pressure =
         FindPressure(load.Attribute("surface"), model);
      if (pressure)
      {
         boundary.normal_traction =
            Sum(*boundary.normal_traction, -1.0, *pressure);
      }
      else
      {
         std::swap(boundary.normal_traction, boundary.effective_traction);
      }
   }
}

void ReadPressure(const FebInput &load, BoundaryCase &boundary,
                  const FebModel &model)
{
   load.Expect("linear", false,
               "pressures on the undeformed surface are not known");
   load.Ignore("symmetric_stiffness", "the tangent is complete");
   boundary.normal_traction = Scaled(-1.0, model.Value(load, "pressure"));
}

void ReadFluidFlux(const FebInput &load, BoundaryCase &boundary,
                   const FebModel &model)
{
   load.Expect("linear", false,
               "fluxes through the undeformed surface are not known");
   (load.Flag("mixture", false) ? boundary.mixture_flux
                                : boundary.normal_flux) =
      model.Value(load, "flux");
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
      (*boundary.traction)[d] = Scaled(components[d], curve);
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
      AddCondition(boundary, load, model);
   }
}
} // namespace

namespace
{
// Flows of fluid at nodes, as a flux where all have the same share of the
// surface.
void ReadNodalFlux(const FebInput &load, FebModel &model)
{
   const LoadCurve value = model.Value(load, "value");
   const std::string set = load.NeededAttribute("node_set");
   const std::string surface = model.surfaces->OfNodes(set, load);
   if (surface.empty())
   {
      return;
   }
   const std::map<int, real_t> areas = model.surfaces->NodalAreas(surface);
   const auto [least, most] = std::minmax_element(
      areas.begin(), areas.end(),
      [](const auto &a, const auto &b) { return a.second < b.second; });
   if (!(most->second - least->second <= same_area * most->second))
   {
      load.Stop("flows at nodes are only known where all have the same share "
                "of the surface");
      return;
   }
   BoundaryCase boundary;
   boundary.surfaces = {surface};
   boundary.normal_flux = Scaled(1.0 / most->second, value);
   AddCondition(boundary, load, model);
   load.Approximate("the flow is a flux through the surface, which grows with "
                    "its area");
}

void ReadNodalLoad(const FebInput &load, FebModel &model)
{
   load.Attribute("name");
   const std::string type = load.NeededAttribute("type");
   if (type != "nodal fluidflux")
   {
      load.StopAll("loads of nodes of the type \"" + type +
                   "\" are not known; there is nodal fluidflux");
      return;
   }
   load.Expect("relative", false,
               "values relative to those at the start are not known");
   ReadNodalFlux(load, model);
}
} // namespace

namespace
{
// A force per mass, which FEBio takes the other way round.
void ReadBodyLoad(const FebInput &load, FebModel &model)
{
   load.Attribute("name");
   const std::string type = load.NeededAttribute("type");
   if (type != "const" || load.HasAttribute("elem_set"))
   {
      load.StopAll("there are body loads of the type const, of all bodies");
      return;
   }
   if (model.in_step)
   {
      load.StopAll("body loads are only known in all steps");
      return;
   }
   if (!model.setup.acceleration)
   {
      model.setup.acceleration = std::array<LoadCurve, 3>{{0.0, 0.0, 0.0}};
   }
   const char *const axes[3] = {"x", "y", "z"};
   for (int d = 0; d < 3; d++)
   {
      if (const std::optional<FebInput> value = load.Find(axes[d]))
      {
         LoadCurve &sum = (*model.setup.acceleration)[d];
         sum = Sum(sum, -1.0, model.Value(*value));
      }
   }
}
} // namespace

void ReadLoads(const FebInput &section, FebModel &model)
{
   for (const FebInput &load : section.All("body_load"))
   {
      ReadBodyLoad(load, model);
   }
   for (const FebInput &load : section.All("nodal_load"))
   {
      ReadNodalLoad(load, model);
   }
   for (const FebInput &load : section.All("surface_load"))
   {
      ReadSurfaceLoad(load, model);
   }
}

} // namespace synovia
