#include "synovia/runs/problem_report.hpp"
#include "synovia/checks/case_warnings.hpp"
#include "synovia/checks/contact_hints.hpp"
#include "synovia/checks/joint_rows.hpp"
#include "synovia/checks/ligament_rows.hpp"
#include "synovia/checks/region_stiffness.hpp"
#include "synovia/checks/rigid_body_rows.hpp"
#include "synovia/fem/moduli_ratios.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/general/text_table.hpp"
#include "synovia/linalg/direct_preconditioner.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>

namespace synovia
{

using namespace mfem;

namespace
{
// What a run keeps, roughly: bytes for an entry of a matrix, and how much
// larger than the matrices their factors or hierarchies are.
constexpr real_t bytes_an_entry = 12.0;
constexpr real_t copies_with_multigrid = 6.0;
constexpr real_t copies_with_factors = 4.0;
} // namespace

ProblemReport::ProblemReport(const CaseFile &setup, CaseProblem &problem)
   : title(setup.title), order(setup.space.order),
     bodies(problem.Get().Bodies()),
     regions(MeasureRegions(setup, problem, bodies)),
     elements(MeasureElements(problem.Get().Mesh())),
     stiffness(VerifiedStiffness(setup, problem)),
     surfaces(MeasureSurfaces(setup, problem.Get().Mesh())),
     rigid_bodies(
        RigidBodyRows(problem.Get().Conditions(), problem.Get().Spaces())),
     ligaments(LigamentRows(problem.Get().Conditions())),
     joints(JointRows(problem.Get().Conditions())),
     pairs(CheckContact(setup, problem)), ties(CheckTies(setup, problem)),
     warnings(FindWarnings(setup, problem, pairs, bodies, regions)),
     hints(FindContactHints(setup, problem, pairs, bodies, regions))
{
   MPI_Comm_size(problem.Get().Mesh().GetComm(), &ranks);
   const std::vector<std::string> flat =
      FindQualityWarnings(problem.Get().Mesh(), elements);
   warnings.insert(warnings.end(), flat.begin(), flat.end());
   const std::vector<std::string> partial = FindTieHints(setup, ties);
   hints.insert(hints.end(), partial.begin(), partial.end());
   Count(setup, problem);
}

void ProblemReport::Count(const CaseFile &setup, CaseProblem &problem)
{
   BiphasicSpaces &spaces = problem.Get().Spaces();
   displacements = spaces.Displacement().GlobalTrueVSize();
   pressures = spaces.Pressure().GlobalTrueVSize();
   // Entries of the elements' matrices; those of neighbors share about half.
   real_t entries = 0.0;
   const ParMesh &mesh = spaces.GetMesh();
   for (int i = 0; i < mesh.GetNE(); i++)
   {
      const real_t u = 3.0 * spaces.Displacement().GetFE(i)->GetDof();
      const real_t p = spaces.Pressure().GetFE(i)->GetDof();
      entries += 0.5 * (u + p) * (u + p);
   }
   entries = SumOverRanks(entries, mesh.GetComm());
   const real_t unknowns = static_cast<real_t>(displacements + pressures);
   const FactorizationTuning &tuning = setup.solver.tuning.factorization;
   const real_t smoothed = setup.solver.tuning.multigrid.smooth_anisotropy;
   const Vector anisotropy = FindAnisotropy(spaces, problem.Get().Materials());
   const real_t anisotropic =
      SumOverRanks(static_cast<real_t>(std::count_if(
                      anisotropy.begin(), anisotropy.end(),
                      [smoothed](real_t here) { return here > smoothed; })),
                   mesh.GetComm());
   const bool direct =
      ChooseMethod(setup.solver.linear, displacements + pressures,
                   anisotropic > 0.0) == LinearMethod::direct;
   const real_t factorized = direct ? unknowns : anisotropic;
   // Factors of three-dimensional meshes grow like n^(4/3).
   const real_t factors = 25.0 * std::pow(factorized, 4.0 / 3.0);
   // Kept factors collect dense columns where contact changes.
   const real_t columns = direct && !setup.contacts.empty()
                             ? DirectPreconditioner::MostColumns(
                                  setup.solver.linear.renew_after, tuning)
                             : 0.0;
   gigabytes =
      1e-9 * (bytes_an_entry * (entries * (direct ? copies_with_factors
                                                  : copies_with_multigrid) +
                                factors) +
              sizeof(real_t) * columns * unknowns);
}

void ProblemReport::WriteRegions(std::ostream &out) const
{
   out << "\nregions\n";
   std::vector<std::vector<std::string>> rows{
      {"", "elements", "volume", "worst quality", "H_A", "eigenvalues",
       "permeability", "thickness", "drainage length", "gel time"}};
   for (size_t i = 0; i < regions.size(); i++)
   {
      const RegionMeasures &region = regions[i];
      const bool drains = region.gel_time > 0.0;
      rows.push_back(
         {region.name, std::to_string(elements[i].elements),
          Quantity(elements[i].volume), Quantity(elements[i].quality),
          region.rigid ? "rigid" : Quantity(region.aggregate_modulus),
          region.rigid ? "-"
                       : Quantity(stiffness[i].least) + " to " +
                            Quantity(stiffness[i].largest),
          region.permeability > 0.0 ? Quantity(region.permeability)
                                    : "no fluid",
          region.thickness > 0.0 ? Quantity(region.thickness) : "-",
          drains ? Quantity(region.drainage_length) : "-",
          drains ? Quantity(region.gel_time) : "-"});
   }
   WriteTable(out, rows);
}

void ProblemReport::WriteSurfaces(std::ostream &out) const
{
   out << "\nsurfaces\n";
   std::vector<std::vector<std::string>> rows{
      {"", "faces", "area", "conditions"}};
   for (const SurfaceMeasures &surface : surfaces)
   {
      rows.push_back({surface.name, std::to_string(surface.faces),
                      Quantity(surface.area), surface.conditions});
   }
   WriteTable(out, rows);
}

void ProblemReport::WritePairs(std::ostream &out) const
{
   if (pairs.empty())
   {
      return;
   }
   out << "\ncontact pairs\n";
   const bool rub = std::any_of(pairs.begin(), pairs.end(),
                                [](const PairAtStart &pair)
                                { return !pair.friction.empty(); });
   std::vector<std::vector<std::string>> rows{
      {"", "least gap", "gap tolerance", "search radius"}};
   if (rub)
   {
      rows.front().push_back("friction");
   }
   for (const PairAtStart &pair : pairs)
   {
      rows.push_back({pair.name, Quantity(pair.least_gap),
                      Quantity(pair.gap_tolerance),
                      Quantity(pair.search_radius)});
      if (rub)
      {
         rows.back().push_back(pair.friction);
      }
   }
   WriteTable(out, rows);
}

void ProblemReport::Write(std::ostream &out) const
{
   if (!title.empty())
   {
      out << title << '\n';
   }
   WriteRegions(out);
   WriteSurfaces(out);
   if (!rigid_bodies.empty())
   {
      out << "\nrigid bodies\n";
      WriteTable(out, rigid_bodies);
   }
   if (!ligaments.empty())
   {
      out << "\nligaments\n";
      WriteTable(out, ligaments);
   }
   if (!joints.empty())
   {
      out << "\njoints\n";
      WriteTable(out, joints);
   }
   WritePairs(out);
   if (!ties.empty())
   {
      out << "\nties\n";
      WriteTable(out, TieRows(ties));
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
   for (const std::string &hint : hints)
   {
      out << "hint: " << hint << '\n';
   }
}

} // namespace synovia
