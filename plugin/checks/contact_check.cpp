#include "synovia/checks/contact_check.hpp"
#include "synovia/general/reduce.hpp"
#include "synovia/general/text.hpp"
#include "synovia/mesh/named_boundaries.hpp"
#include "synovia/physics/first_approach.hpp"

#include <algorithm>
#include <limits>

namespace synovia
{

using namespace mfem;

namespace
{
// Where the surfaces see each other.
real_t LeastGap(const ContactPair &pair)
{
   const Vector &gap = pair.State().gap;
   real_t least = std::numeric_limits<real_t>::infinity();
   for (int j = 0; j < gap.Size(); j++)
   {
      if (pair.Constraint().Coverage().area[j] > 0.0)
      {
         least = std::min(least, gap[j]);
      }
   }
   return -MaxOverRanks(-least, pair.Geometry().Source().Spaces().GetComm());
}

std::string FrictionOf(const ContactOptions &options, const ContactPair &pair)
{
   return options.friction.coefficient == 0.0
             ? ""
             : ToText(options.friction.coefficient) + ", solid fraction " +
                  ToText(pair.Scales().solid_fraction);
}
} // namespace

std::vector<PairAtStart> CheckContact(const CaseFile &setup,
                                      CaseProblem &problem)
{
   const NamedMesh &mesh = problem.Get().Mesh();
   BiphasicSpaces &spaces = problem.Get().Spaces();
   std::vector<std::unique_ptr<ContactPair>> pairs;
   std::vector<ContactPair *> borrowed;
   std::vector<PairAtStart> found;
   CaseReading reading(setup.places);
   const auto collect = [&](size_t i, auto check)
   { reading.Catch("contact." + std::to_string(i), check); };
   for (size_t i = 0; i < setup.contacts.size(); i++)
   {
      const ContactCase &contact = setup.contacts[i];
      collect(i,
              [&]()
              {
                 pairs.push_back(std::make_unique<ContactPair>(
                    contact.Name(), spaces, problem.Get().Materials(),
                    NamedBoundaries(mesh, contact.source),
                    NamedBoundaries(mesh, contact.destination), contact.options,
                    problem.Get().GetDeformation(),
                    setup.solver.tuning.contact));
                 borrowed.push_back(pairs.back().get());
                 borrowed.back()->SearchReference();
              });
   }
   reading.ThrowIfAny();
   Vector u;
   reading.Catch(setup.rigid_bodies.empty() ? "boundary" : "rigid_body",
                 [&]()
                 {
                    u = MakeFirstApproach(problem.Get().Bodies(), spaces,
                                          problem.Get().Conditions(), borrowed)
                           .displacement;
                 });
   reading.ThrowIfAny();
   Vector p(spaces.Pressure().GetTrueVSize());
   p = 0.0;
   for (size_t i = 0; i < pairs.size(); i++)
   {
      collect(i,
              [&]()
              {
                 ContactPair &pair = *pairs[i];
                 pair.Enforcement().SetTimeStep(setup.time.step);
                 pair.Search(u);
                 pair.Enforcement().Evaluate(u, p);
                 found.push_back({pair.Name(), LeastGap(pair),
                                  pair.Scales().gap_tolerance,
                                  pair.Scales().search_radius,
                                  FrictionOf(setup.contacts[i].options, pair)});
              });
   }
   reading.ThrowIfAny();
   return found;
}

} // namespace synovia
