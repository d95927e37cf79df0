#include "cases/problem_report.hpp"
#include "cases/body.hpp"
#include "cases/stiffness_range.hpp"
#include "general/error.hpp"
#include "general/reduce.hpp"
#include "general/text.hpp"
#include "mesh/element_measure.hpp"
#include "mesh/mesh_quality.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <ostream>
#include <sstream>

namespace synovia
{

using namespace mfem;

namespace
{
// Loads and gel times that are farther apart than this look like a mistake.
constexpr real_t far_apart = 1e3;
// Elements below this are flat enough to spoil stresses and iterations.
constexpr real_t poor_quality = 0.1;
// What a run keeps, roughly: bytes for an entry of a matrix, and how much
// larger than the matrices their factors or hierarchies are.
constexpr real_t bytes_an_entry = 12.0;
constexpr real_t copies_with_multigrid = 6.0;
constexpr real_t copies_with_factors = 4.0;

void SumOverRanks(std::vector<real_t> &values, MPI_Comm comm)
{
   MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()),
                 MPITypeMap<real_t>::mpi_type, MPI_SUM, comm);
}

/// Lengths of time in which loads change.
struct LoadTimes
{
   real_t shortest = std::numeric_limits<real_t>::infinity();
   real_t longest = 0.0;
   /// When the last change ends.
   real_t last = 0.0;

   void Add(const LoadCurve &curve)
   {
      const std::vector<real_t> &times = curve.Corners();
      for (size_t i = 1; i < times.size(); i++)
      {
         if (curve(times[i]) != curve(times[i - 1]))
         {
            shortest = std::min(shortest, times[i] - times[i - 1]);
            longest = std::max(longest, times[i] - times[i - 1]);
            last = std::max(last, times[i]);
         }
      }
   }
   void Add(const std::optional<LoadCurve> &curve)
   {
      if (curve)
      {
         Add(*curve);
      }
   }
};

LoadTimes FindLoadTimes(const CaseFile &setup)
{
   LoadTimes times;
   for (const BoundaryCase &boundary : setup.boundaries)
   {
      for (int d = 0; d < 3; d++)
      {
         times.Add(boundary.displacement[d]);
         if (boundary.traction)
         {
            times.Add((*boundary.traction)[d]);
         }
      }
      times.Add(boundary.pressure);
      times.Add(boundary.normal_traction);
      times.Add(boundary.normal_flux);
   }
   return times;
}

// Attributes of the surfaces from which fluid may leave.
Array<int> DrainingSurfaces(const CaseFile &setup, const NamedMesh &mesh)
{
   Array<int> draining = ContactSurfaces(setup, mesh);
   for (const BoundaryCase &boundary : setup.boundaries)
   {
      if (boundary.pressure)
      {
         for (const std::string &name : boundary.surfaces)
         {
            draining.Append(mesh.Boundary(name));
         }
      }
   }
   return draining;
}

// The path of the material that a region has.
std::string PathOfMaterial(const CaseFile &setup, const NamedMesh &mesh,
                           const std::string &region)
{
   for (size_t i = 0; i < setup.materials.size(); i++)
   {
      for (const std::string &name : setup.materials[i].regions)
      {
         for (const int attribute : mesh.Region(name))
         {
            if (NameOf(mesh.Regions(), attribute) == region)
            {
               return "material." + std::to_string(i);
            }
         }
      }
   }
   return "material";
}

std::string Quantity(real_t value)
{
   std::ostringstream text;
   text << std::setprecision(4) << value;
   return text.str();
}

void WriteTable(std::ostream &out,
                const std::vector<std::vector<std::string>> &rows)
{
   std::vector<size_t> widths;
   for (const std::vector<std::string> &row : rows)
   {
      widths.resize(std::max(widths.size(), row.size()));
      for (size_t i = 0; i < row.size(); i++)
      {
         widths[i] = std::max(widths[i], row[i].size());
      }
   }
   for (const std::vector<std::string> &row : rows)
   {
      out << ' ';
      for (size_t i = 0; i < row.size(); i++)
      {
         out << ' ' << (i == 0 ? std::left : std::right)
             << std::setw(static_cast<int>(widths[i]) + (i == 0 ? 0 : 1))
             << row[i];
      }
      out << std::right << '\n';
   }
}
} // namespace

ProblemReport::ProblemReport(const CaseFile &setup, CaseProblem &problem)
   : title(setup.title), order(setup.space.order)
{
   MPI_Comm_size(problem.Get().Mesh().GetComm(), &ranks);
   MeasureRegions(setup, problem);
   VerifyStiffness(setup, problem.Get().Mesh());
   MeasureSurfaces(problem.Get().Mesh());
   pairs = CheckContact(setup, problem);
   Count(setup, problem);
   WarnOfTimes(setup);
   WarnOfBodies(setup, problem);
}

void ProblemReport::MeasureRegions(const CaseFile &setup, CaseProblem &problem)
{
   NamedMesh &named = problem.Get().Mesh();
   ParMesh &mesh = named.Get();
   const MPI_Comm comm = named.GetComm();
   const int count = mesh.attributes.Max() + 1;
   std::vector<real_t> elements(count, 0.0);
   std::vector<real_t> volume(count, 0.0);
   std::vector<real_t> area(count, 0.0);
   std::vector<real_t> quality(count, std::numeric_limits<real_t>::infinity());
   std::vector<real_t> least(quality);
   std::vector<real_t> largest(count, 0.0);
   const Vector jacobians = ScaledJacobians(mesh);
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      const int region = mesh.GetAttribute(i);
      ElementTransformation &trans = *mesh.GetElementTransformation(i);
      elements[region] += 1.0;
      volume[region] += Measure(trans);
      quality[region] = std::min(quality[region], jacobians[i]);
      const StiffnessRange range =
         RangeOfStiffness(*problem.Get().Materials().Get(region).solid, trans);
      least[region] = std::min(least[region], range.least);
      largest[region] = std::max(largest[region], range.largest);
   }
   const Array<int> draining = DrainingSurfaces(setup, named);
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      if (draining.Find(mesh.GetBdrAttribute(i)) >= 0)
      {
         int element;
         int info;
         mesh.GetBdrElementAdjacentElement(i, element, info);
         area[mesh.GetAttribute(element)] +=
            Measure(*mesh.GetBdrElementTransformation(i));
      }
   }
   SumOverRanks(elements, comm);
   SumOverRanks(volume, comm);
   SumOverRanks(area, comm);
   for (auto *values : {&quality, &least})
   {
      MPI_Allreduce(MPI_IN_PLACE, values->data(), count,
                    MPITypeMap<real_t>::mpi_type, MPI_MIN, comm);
   }
   MPI_Allreduce(MPI_IN_PLACE, largest.data(), count,
                 MPITypeMap<real_t>::mpi_type, MPI_MAX, comm);
   for (const int attribute : mesh.attributes)
   {
      const Material &material = problem.Get().Materials().Get(attribute);
      Region region;
      region.name = NameOf(named.Regions(), attribute);
      region.elements = static_cast<long long>(elements[attribute]);
      region.volume = volume[attribute];
      region.quality = quality[attribute];
      region.aggregate_modulus = material.solid->AggregateModulus();
      region.least_eigenvalue = least[attribute];
      region.largest_eigenvalue = largest[attribute];
      region.permeability = material.permeability->Typical();
      if (area[attribute] > 0.0)
      {
         region.thickness = volume[attribute] / area[attribute];
         region.gel_time = region.thickness * region.thickness /
                           (region.aggregate_modulus * region.permeability);
      }
      regions.push_back(region);
      if (region.quality < poor_quality)
      {
         warnings.push_back("the worst element of \"" + region.name +
                            "\" has a scaled Jacobian of " +
                            Quantity(region.quality) +
                            " (1 is perfect, 0 is flat)");
      }
   }
}

void ProblemReport::VerifyStiffness(const CaseFile &setup,
                                    const NamedMesh &mesh) const
{
   CaseReading reading(setup.places);
   for (const Region &region : regions)
   {
      if (!(region.least_eigenvalue > 0.0) ||
          !std::isfinite(region.largest_eigenvalue))
      {
         reading.Complain(
            PathOfMaterial(setup, mesh, region.name) + ".solid",
            "the stiffness of \"" + region.name +
               "\" is not positive definite: its eigenvalues go from " +
               Quantity(region.least_eigenvalue) + " to " +
               Quantity(region.largest_eigenvalue));
      }
   }
   reading.ThrowIfAny();
}

void ProblemReport::MeasureSurfaces(const NamedMesh &named)
{
   ParMesh &mesh = const_cast<ParMesh &>(named.Get());
   const int count =
      mesh.bdr_attributes.IsEmpty() ? 1 : mesh.bdr_attributes.Max() + 1;
   std::vector<real_t> faces(count, 0.0);
   std::vector<real_t> area(count, 0.0);
   for (int i = 0; i < mesh.GetNBE(); i++)
   {
      const int surface = mesh.GetBdrAttribute(i);
      faces[surface] += 1.0;
      area[surface] += Measure(*mesh.GetBdrElementTransformation(i));
   }
   SumOverRanks(faces, named.GetComm());
   SumOverRanks(area, named.GetComm());
   for (const auto &[name, attributes] : named.Boundaries())
   {
      Surface surface;
      surface.name = name;
      for (const int attribute : attributes)
      {
         surface.faces += static_cast<long long>(faces[attribute]);
         surface.area += area[attribute];
      }
      surfaces.push_back(surface);
   }
}

void ProblemReport::Count(const CaseFile &setup, CaseProblem &problem)
{
   BiphasicSpaces &spaces = problem.Get().Spaces();
   displacements = spaces.Displacement().GlobalTrueVSize();
   pressures = spaces.Pressure().GlobalTrueVSize();
   // Entries of the elements' matrices; those of neighbours share about half.
   real_t entries = 0.0;
   const ParMesh &mesh = spaces.GetMesh();
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      const real_t u = 3.0 * spaces.Displacement().GetFE(i)->GetDof();
      const real_t p = spaces.Pressure().GetFE(i)->GetDof();
      entries += 0.5 * (u + p) * (u + p);
   }
   entries = synovia::SumOverRanks(entries, mesh.GetComm());
   const real_t unknowns = static_cast<real_t>(displacements + pressures);
   const bool direct =
      ChooseMethod(
         setup.solver.linear, displacements + pressures,
         FindModuliRatios(spaces.GetMesh(), problem.Get().Materials())) ==
      LinearMethod::direct;
   // Factors of three-dimensional meshes grow like n^(4/3).
   const real_t factors = direct ? 25.0 * std::pow(unknowns, 4.0 / 3.0) : 0.0;
   gigabytes =
      1e-9 * bytes_an_entry *
      (entries * (direct ? copies_with_factors : copies_with_multigrid) +
       factors);
}

void ProblemReport::WarnOfTimes(const CaseFile &setup)
{
   const LoadTimes loads = FindLoadTimes(setup);
   real_t shortest = std::numeric_limits<real_t>::infinity();
   real_t longest = 0.0;
   for (const Region &region : regions)
   {
      if (region.gel_time > 0.0)
      {
         shortest = std::min(shortest, region.gel_time);
         longest = std::max(longest, region.gel_time);
      }
   }
   if (longest > 0.0 && loads.longest > far_apart * longest)
   {
      warnings.push_back("a load takes " + Quantity(loads.longest) +
                         ", which is much slower than any gel time (" +
                         Quantity(longest) +
                         " at most): there will be hardly any fluid pressure; "
                         "are the units of the permeability right?");
   }
   if (longest > 0.0 && loads.shortest * far_apart < shortest)
   {
      warnings.push_back("a load takes " + Quantity(loads.shortest) +
                         ", which is much faster than any gel time (" +
                         Quantity(shortest) +
                         " at least): hardly any fluid will move; are the "
                         "units of the permeability right?");
   }
   if (loads.last > setup.time.end)
   {
      warnings.push_back("loads change until " + Quantity(loads.last) +
                         ", and the run ends at " + Quantity(setup.time.end));
   }
   for (const LineCase &line : setup.output.lines)
   {
      for (const real_t time : line.times)
      {
         if (time > setup.time.end * (1.0 + 1e-9))
         {
            warnings.push_back("the line \"" + line.line.name +
                               "\" is not sampled at " + Quantity(time) +
                               ", for the run ends at " +
                               Quantity(setup.time.end));
         }
      }
   }
}

void ProblemReport::WarnOfBodies(const CaseFile &setup, CaseProblem &problem)
{
   NamedMesh &mesh = problem.Get().Mesh();
   const Array<int> draining = DrainingSurfaces(setup, mesh);
   const char *const axes[3] = {"x", "y", "z"};
   const Array<int> held[3] = {HeldSurfaces(setup, mesh, 0),
                               HeldSurfaces(setup, mesh, 1),
                               HeldSurfaces(setup, mesh, 2)};
   for (const Body &body : FindBodies(mesh, problem.Get().Spaces()))
   {
      if (!body.Touches(draining))
      {
         warnings.push_back("no fluid can leave \"" + body.name +
                            "\": it has no surface with a pressure or in a "
                            "contact pair");
      }
      for (int d = 0; d < 3; d++)
      {
         if (!body.Touches(held[d]))
         {
            warnings.push_back("only contact holds \"" + body.name +
                               "\" along " + axes[d]);
         }
      }
   }
}

void ProblemReport::Write(std::ostream &out) const
{
   if (!title.empty())
   {
      out << title << '\n';
   }
   out << "\nregions\n";
   std::vector<std::vector<std::string>> rows{
      {"", "elements", "volume", "worst quality", "H_A", "eigenvalues",
       "permeability", "thickness", "gel time"}};
   for (const Region &region : regions)
   {
      const bool drains = region.gel_time > 0.0;
      rows.push_back({region.name, std::to_string(region.elements),
                      Quantity(region.volume), Quantity(region.quality),
                      Quantity(region.aggregate_modulus),
                      Quantity(region.least_eigenvalue) + " to " +
                         Quantity(region.largest_eigenvalue),
                      Quantity(region.permeability),
                      drains ? Quantity(region.thickness) : "-",
                      drains ? Quantity(region.gel_time) : "-"});
   }
   WriteTable(out, rows);
   out << "\nsurfaces\n";
   rows = {{"", "faces", "area"}};
   for (const Surface &surface : surfaces)
   {
      rows.push_back(
         {surface.name, std::to_string(surface.faces), Quantity(surface.area)});
   }
   WriteTable(out, rows);
   if (!pairs.empty())
   {
      out << "\ncontact pairs\n";
      rows = {{"", "least gap", "gap tolerance", "search radius"}};
      for (const PairAtStart &pair : pairs)
      {
         rows.push_back({pair.name, Quantity(pair.least_gap),
                         Quantity(pair.gap_tolerance),
                         Quantity(pair.search_radius)});
      }
      WriteTable(out, rows);
   }
   out << "\norder " << order << ": " << displacements << " displacements, "
       << pressures << " pressures on " << ranks
       << (ranks == 1 ? " rank" : " ranks") << ", about "
       << std::setprecision(2) << std::max(gigabytes, real_t(0.1))
       << std::setprecision(6) << " GB of memory in all\n";
   for (const std::string &warning : warnings)
   {
      out << "warning: " << warning << '\n';
   }
}

} // namespace synovia
