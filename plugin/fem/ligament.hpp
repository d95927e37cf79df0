#pragma once

#include "synovia/general/point3.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// One end of a ligament.
struct LigamentEnd
{
   /// The rigid body that it is attached to; empty: space.
   std::string body{};
   /// As meshed (length).
   Point3 point{{0.0, 0.0, 0.0}};
};

/// How a ligament resists, see LigamentLaw.
struct LigamentOptions
{
   /// Beyond the toe region: force / length, or force per strain (force). One
   /// of them is positive, the other one 0.
   mfem::real_t stiffness = 0.0;
   mfem::real_t strain_stiffness = 0.0;
   /// Length without force (length); 0: as the strain says.
   mfem::real_t slack_length = 0.0;
   /// Strain as meshed, negative where it is slack; more than -1.
   mfem::real_t prestrain = 0.0;
   /// Where the toe region ends and the linear one begins; 0: there is none.
   mfem::real_t toe_strain = 0.0;
   /// Whether it resists being shorter than the slack length, as springs do.
   bool compression = false;
};

/// What makes no sense in the options; empty if there is nothing.
std::string Contradiction(const LigamentOptions &options);

/// A ligament or a spring: straight, from a point to another one.
struct Ligament
{
   /// In messages and output.
   std::string name{};
   LigamentEnd from{};
   LigamentEnd to{};
   LigamentOptions options{};

   /// As meshed (length).
   mfem::real_t Distance() const
   {
      return Length(Sum(to.point, -1.0, from.point));
   }
};

/// What makes no sense in it where there are these rigid bodies; empty if there
/// is nothing.
std::string Contradiction(const Ligament &ligament,
                          const std::vector<std::string> &bodies);

/// The force of a ligament by its length l: with the strain e = l/l_0 - 1 from
/// the slack length l_0, and tension positive,
///
///     f = 0                     where e < 0,
///     f = K e^2 / (2 e_toe)     where 0 < e < e_toe,
///     f = K (e - e_toe/2)       beyond,
///
/// after Blankevoort et al. (J Biomech 24(11):1019-1031, 1991), whose e_l is
/// e_toe/2. A spring, without toe region, has f = K e everywhere.
class LigamentLaw
{
public:
   /// For a ligament with options that don't contradict themselves.
   explicit LigamentLaw(const Ligament &ligament);

   mfem::real_t Force(mfem::real_t length) const;
   /// Derivative of the force (force / length).
   mfem::real_t Slope(mfem::real_t length) const;
   /// Whether it resists small changes of the length.
   bool Resists(mfem::real_t length) const;
   mfem::real_t SlackLength() const { return slack_length; }
   /// Force per strain beyond the toe region (force).
   mfem::real_t StrainStiffness() const { return stiffness; }

private:
   mfem::real_t Strain(mfem::real_t length) const
   {
      return length / slack_length - 1.0;
   }
   bool IsInToe(mfem::real_t strain) const { return toe > 0.0 && strain < toe; }

   mfem::real_t slack_length;
   mfem::real_t stiffness;
   mfem::real_t toe;
   bool compression;
};

} // namespace synovia
