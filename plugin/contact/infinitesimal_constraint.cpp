#include "synovia/contact/infinitesimal_constraint.hpp"

namespace synovia
{

using namespace mfem;

InfinitesimalConstraint::InfinitesimalConstraint(
   ContactGeometry &geometry_, SearchConfiguration configuration_,
   InitialOverlap initial_overlap_)
   : geometry(geometry_), configuration(configuration_),
     initial_overlap(initial_overlap_),
     removed_overlap(geometry.DestinationAreas().Size())
{
   removed_overlap = 0.0;
}

void InfinitesimalConstraint::SearchReference()
{
   if (operators.gap)
   {
      return;
   }
   operators = geometry.Search();
   const Vector overlap = geometry.FindOverlap(operators, operators.gap_offset);
   if (initial_overlap == InitialOverlap::remove)
   {
      removed_overlap = overlap;
   }
}

void InfinitesimalConstraint::SearchAt(const Vector &u)
{
   geometry.SetDisplacement(u);
   operators = geometry.Search();
}

bool InfinitesimalConstraint::Search(const Vector &u)
{
   if (!reached)
   {
      SearchReference();
      geometry.VerifyReach(operators);
      reached = true;
   }
   if (configuration == SearchConfiguration::current)
   {
      SearchAt(u);
   }
   else if (searched)
   {
      return false;
   }
   else if (!operators.gap)
   {
      operators = geometry.Search();
   }
   searched = true;
   return true;
}

void InfinitesimalConstraint::Evaluate(const Vector &u, const Vector &p,
                                       Vector &gap, Vector &jump,
                                       Vector &pressure)
{
   operators.gap->Mult(u, gap);
   MultJump(*operators.jump, geometry.Destination(), p, jump, pressure);
   gap.HostReadWrite();
   for (int j = 0; j < gap.Size(); j++)
   {
      gap[j] += operators.gap_offset[j] +
                (operators.area[j] > 0.0 ? removed_overlap[j] : 0.0);
   }
}

ContactFactors InfinitesimalConstraint::Factors() const
{
   ContactFactors factors;
   factors.gap = factors.gap_change = operators.gap.get();
   factors.jump = operators.jump.get();
   return factors;
}

void InfinitesimalConstraint::Archive(StateArchive &archive,
                                      const std::string &prefix)
{
   archive.Flag(prefix + "reached", reached);
   geometry.Destination().Archive(archive, prefix + "removed_overlap",
                                  removed_overlap);
}

} // namespace synovia
