#pragma once

#include "synovia/contact/contact_coverage.hpp"
#include "synovia/contact/contact_scales.hpp"

#include <limits>

namespace synovia
{

/// Factors by which penalties were raised.
struct Stiffening
{
   mfem::real_t gap = 1.0;
   mfem::real_t jump = 1.0;
};

/// Penalties at the vertices of the destination, given or derived; see
/// ContactOptions.
class ContactPenalties
{
public:
   /// @param vertex_areas   whole areas of the destination's vertices
   ContactPenalties(const ContactOptions &options, const ContactScales &scales,
                    const mfem::Vector &vertex_areas);

   /// For steps of length @a dt (time), until then for steady flow; says
   /// whether that is another one. Update() must follow.
   bool SetTimeStep(mfem::real_t dt);
   void Update(const ContactCoverage &coverage, const Stiffening &stiffening);

   /// eta (stress / length).
   const mfem::Vector &Gap() const { return gap; }
   /// eta_p (length / time / stress).
   const mfem::Vector &Jump() const { return jump; }
   /// Stiffness of the bodies at a vertex (stress / length), and its product
   /// with the area (force / length).
   const mfem::Vector &Resistance() const { return resistance; }
   const mfem::Vector &AreaResistance() const { return area_resistance; }
   /// Flux that the bodies take up for a pressure at a vertex (length / time /
   /// stress).
   const mfem::Vector &Conductance() const { return conductance; }

private:
   ContactOptions options;
   ContactScales scales;
   mfem::Vector vertex_areas;
   mfem::real_t time_step = std::numeric_limits<mfem::real_t>::infinity();
   mfem::Vector gap;
   mfem::Vector jump;
   mfem::Vector resistance;
   mfem::Vector area_resistance;
   mfem::Vector conductance;
};

} // namespace synovia
