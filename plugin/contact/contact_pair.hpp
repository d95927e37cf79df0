#pragma once

#include "synovia/contact/contact_factors.hpp"
#include "synovia/contact/gap_operators.hpp"
#include "synovia/general/state_archive.hpp"
#include "synovia/materials/material_table.hpp"

#include <limits>
#include <memory>
#include <string>

namespace synovia
{

/// The configuration in which the surfaces look for each other.
enum class SearchConfiguration
{
   /// The undeformed one, once: the linear theory of small displacements to the
   /// letter. Contact is then linear but for its inequalities.
   reference,
   /// The deformed one, anew in every step: for sliding that is not small
   /// beside the contact. Points change partners without the geometric
   /// stiffness that belongs to it, so that thin layers under a traction of
   /// several times their shear modulus may buckle.
   current
};

/// What becomes of surfaces that overlap as meshed.
enum class InitialOverlap
{
   /// The first step presses the overlap out, which strains the bodies.
   press_out,
   /// Gaps are measured from the overlap: vertices of the destination that
   /// overlap start as if they just touched.
   remove
};

/// How contact is enforced. Zero means: derived from the bodies.
struct ContactOptions
{
   /// eta (stress / length). Derived: penalty_factor x H_A / h of the softer
   /// side, h being the size of the destination's faces around a vertex; more
   /// where the source covers only a part of what belongs to the vertex.
   mfem::real_t penalty = 0.0;
   /// eta_p (flux / stress). Derived: penalty_factor x (kappa / h + h / (H_A
   /// dt)), of the less permeable and of the softer side: what an element
   /// resists by flow and, in a short step, by its volume.
   mfem::real_t pressure_penalty = 0.0;
   /// Results must not depend on it, iteration counts may.
   mfem::real_t penalty_factor = 100.0;
   /// Largest gap left between surfaces in contact (length). Derived: 1e-5 of
   /// the destination layer's thickness.
   mfem::real_t gap_tolerance = 0.0;
   /// Largest pressure jump left, as a fraction of the peak pressure.
   mfem::real_t pressure_tolerance = 1e-3;
   /// How far the destination looks for the source (length). Derived: the
   /// destination layer's thickness.
   mfem::real_t search_radius = 0.0;
   SearchConfiguration configuration = SearchConfiguration::reference;
   InitialOverlap initial_overlap = InitialOverlap::press_out;
   /// A deeper one is an error (length). Derived: a tenth of the destination
   /// layer's thickness.
   mfem::real_t overlap_limit = 0.0;
   ContactNormal normal = ContactNormal::destination;
   /// Exactness of the quadrature on each segment, the part of a destination
   /// face that one source face covers.
   int quadrature_order = 5;
};

/// Two surfaces that may come into contact: constraint, active set,
/// multipliers.
///
/// Frictionless and biphasic (Guo & Spilker 2014, equations 10 to 13): in
/// contact the normal traction t = lambda + eta g is compressive (negative) and
/// acts on both surfaces, and the relative flux mu + eta_p (p_A - p_B) out of
/// the source goes into the destination. A vertex of the destination is in
/// contact where lambda + eta g < 0. Vectors have one entry a multiplier true
/// dof.
class ContactPair
{
public:
   /// Collective. Borrows @a spaces and @a materials. Throws Error if the two
   /// sides share a vertex, if a side has no faces, or on options out of range.
   ContactPair(const std::string &name, BiphasicSpaces &spaces,
               const MaterialTable &materials,
               const mfem::Array<int> &source_boundary,
               const mfem::Array<int> &destination_boundary,
               const ContactOptions &options);

   const std::string &Name() const { return name; }
   const ContactSurface &Source() const { return source; }
   const mfem::Array<int> &DestinationBoundary() const
   {
      return destination_boundary;
   }
   const ContactSurface &Destination() const { return destination; }

   /// Vertices (multiplier true dofs) whose pressure boundary conditions hold:
   /// no fluid passes those of the destination, as no pressure of theirs could
   /// close the jump.
   void SetHeldPressures(const mfem::Array<int> &vertices);

   /// Prepares for steps of length @a dt (time); until then for steady flow.
   void SetTimeStep(mfem::real_t dt);

   /// Lets the undeformed surfaces look for each other, unless they have done
   /// so. Collective. Throws Error if they overlap too deeply.
   void LookAsMeshed();
   /// Lets the surfaces look for each other at displacement @a u (true dofs):
   /// before the first Search() for where the run is to start, which stands for
   /// the undeformed configuration then. Collective.
   void LookAt(const mfem::Vector &u);

   /// Moves the surfaces to displacement @a u (true dofs), searches, and
   /// assembles the gap operators, unless they hold for good; says whether it
   /// did. Collective. The first call looks as meshed before, unless that, or
   /// where to start, was looked at; it throws Error if nothing is within the
   /// search radius.
   bool Search(const mfem::Vector &u);
   const GapOperators &Operators() const { return operators; }

   /// Evaluates gap and pressure jump at the given true dofs. Collective.
   void Evaluate(const mfem::Vector &u, const mfem::Vector &p);

   /// Lets the next UpdateActiveSet() take vertices within the gap tolerance
   /// for touching, and hold them, and the nearest one in any case if it is as
   /// near as round surfaces in contact at a point are: a guess to start from
   /// where nothing is known of the traction.
   void AssumeTouching() { assume_touching = true; }

   /// Decides which vertices are in contact and which of them seal the surface,
   /// from the last Evaluate(). A vertex seals where the source covers it and
   /// no more than the gap tolerance is open: nothing drains through less, and
   /// a seal that broke with every tensile vertex would not let Newton's method
   /// settle. Nor would one that breaks and closes with the fluid's pressure
   /// again and again: in a stage each may break once. Collective; true if any
   /// rank's set changed.
   bool UpdateActiveSet();

   /// Traction and flux from the last Evaluate(), of the active set as it is.
   void UpdateTractions();

   /// 1 for the vertices of either surface that this pair seals. Collective.
   mfem::Vector SealedVertices() const;

   /// Adds the nodal contact forces to @a momentum (force), and the fluid that
   /// contact moves out of the nodes to @a mass (volume / time). Collective.
   void AddForces(mfem::Vector &momentum, mfem::Vector &mass) const;

   /// Adds |G|^T W |G| u to @a momentum and |J|^T W_p |J| p to @a mass, for
   /// vectors of absolute values: what round-off is relative to. Collective.
   void AddMagnitudes(const mfem::Vector &u, const mfem::Vector &p,
                      mfem::Vector &momentum, mfem::Vector &mass) const;

   /// Of the linearized equations at the last UpdateActiveSet(). Searched.
   ContactFactors Factors() const;

   /// Weights of the semi-definite terms G^T W G and J^T W_p J.
   const mfem::Vector &GapWeights() const { return gap_weights; }
   const mfem::Vector &JumpWeights() const { return jump_weights; }
   /// Those of the gaps, but no more than the bodies resist.
   mfem::Vector SoftGapWeights() const;

   /// Whether gap and jump are within tolerance; @a peak_pressure as found on
   /// all ranks. Collective.
   bool Converged(mfem::real_t peak_pressure) const;

   /// lambda <- lambda + eta g, mu <- mu + eta_p (p_A - p_B). The next
   /// UpdateActiveSet() releases nothing: a multiplier that is corrected by
   /// more than itself would else let go of all at once.
   void Augment();

   /// Before the first UpdateActiveSet() of a stage.
   void StartStage();
   /// To be called with each augmentation: raises the penalty of what is out of
   /// tolerance and has hardly become smaller since the last one. Penalties
   /// derived from the drained stiffness are too soft where a thin layer is
   /// loaded at once, and holds its fluid. Says whether it did. Collective.
   bool StiffenIfSlow(mfem::real_t peak_pressure);

   /// Keeps the multipliers as those reached at @a time. The penalty's share of
   /// the traction goes into them.
   void Store(mfem::real_t time);
   /// Sets the multipliers for a solve at @a time: extrapolated from the last
   /// two that were stored, as far as there are.
   void Predict(mfem::real_t time);
   /// Leaves one time to predict from: multipliers will change otherwise than
   /// they did.
   void ForgetPast();

   /// Remembers everything that a step changes, and goes back to what was
   /// remembered, but for the gap operators: the next Search() makes those.
   void Accept();
   void Restore();

   /// Whether there was contact at any Accept(). Collective.
   bool HasTouched() const;

   /// Lists what was remembered; reading sets it. Collective.
   void Archive(StateArchive &archive);

   /// Area of the destination in contact: where the mean traction around the
   /// vertices, less what it would take to close the mean gap there, is
   /// compressive, interpolated linearly. So the rim of the contact moves
   /// continuously through the faces as the load does. What closes a gap is
   /// taken as H_A / (2 h) times the gap, of the softer body and with the size
   /// h of the faces: each side gives way by half. Of faces that the source
   /// covers in part, that part counts. Collective.
   mfem::real_t Area() const;

   /// What there is to report of the last Evaluate() and UpdateActiveSet().
   struct Diagnostics
   {
      Point3 source_force{{0.0, 0.0, 0.0}};
      Point3 destination_force{{0.0, 0.0, 0.0}};
      /// Moments of the nodal forces about the origin, with the positions that
      /// the surfaces were searched in (force x length).
      Point3 source_moment{{0.0, 0.0, 0.0}};
      Point3 destination_moment{{0.0, 0.0, 0.0}};
      /// Part of the force on the destination that its fluid pressure in the
      /// contact area makes up; 0 without contact.
      mfem::real_t fluid_load_support = 0.0;
      /// See Area().
      mfem::real_t area = 0.0;
      mfem::real_t penetration = 0.0;
      mfem::real_t pressure_jump = 0.0;
      mfem::real_t peak_traction = 0.0;
      /// Of the destination's fluid, averaged over a vertex's surroundings.
      mfem::real_t peak_pressure = 0.0;
      /// Fluid volume per time from the source into the destination.
      mfem::real_t fluid_exchange = 0.0;
   };
   /// Collective.
   Diagnostics Diagnose() const;

   /// Contact traction, negative in compression, and gap at the vertices of the
   /// destination; zero elsewhere.
   const mfem::Vector &Traction() const { return traction; }
   const mfem::Vector &Gap() const { return gap; }
   /// 1 in contact, 0 not.
   const mfem::Vector &Status() const { return active; }
   mfem::real_t GapTolerance() const { return gap_tolerance; }
   /// Weighted gaps of round surfaces that touch at a point are a small part of
   /// the size of the faces around it (length).
   mfem::real_t GrazingGap(int vertex) const
   {
      return 0.05 * operators.face_size[vertex];
   }
   mfem::real_t SearchRadius() const { return gap_options.search_radius; }

private:
   bool Exchanges(int vertex) const
   {
      return sealing[vertex] > 0.5 && !pressure_held[vertex];
   }
   void TakeMultipliers();
   mfem::real_t TouchingGap() const;
   void SetPenalties();
   void Assemble();
   void VerifyReach() const;
   mfem::real_t FluidLoadSupport() const;
   /// What augmentations have to make small.
   struct Violations
   {
      mfem::real_t penetration = 0.0;
      mfem::real_t pressure_jump = 0.0;
   };
   /// Collective.
   Violations WorstViolations() const;
   /// What Evaluate(), UpdateActiveSet() and Augment() set.
   std::array<mfem::Vector *, 10> WorkingVectors();

   std::string name;
   MPI_Comm comm;
   ContactOptions options;
   mfem::Array<int> destination_boundary;
   ContactSurface source;
   ContactSurface destination;
   GapOptions gap_options;
   mfem::real_t gap_tolerance;
   mfem::real_t overlap_limit;
   mfem::real_t softest_modulus;
   mfem::real_t least_permeability;
   /// Of the displacement's nodes: as meshed, and when they were searched.
   mfem::Vector reference_positions;
   mfem::Vector searched_positions;
   mfem::Vector source_areas;
   mfem::Vector destination_areas;
   GapOperators operators;
   bool searched = false;
   bool assume_touching = false;
   bool release_nothing = false;
   /// Before the first iteration of a stage.
   bool predicting = false;
   mfem::Array<bool> pressure_held;
   /// Seals that broke in this stage.
   mfem::Array<bool> seal_opened;
   mfem::real_t time_step = std::numeric_limits<mfem::real_t>::infinity();
   bool reached = false;
   /// A vertex of this rank, in what was accepted.
   bool touched = false;

   /// What the bodies resist at a vertex (stress / length).
   mfem::Vector resistance;
   /// That times the area (force / length).
   mfem::Vector gap_resistance;
   mfem::Vector penalty;
   mfem::Vector pressure_penalty;
   mfem::Vector multiplier;
   mfem::Vector flux_multiplier;
   /// Multipliers at two times, the later one second.
   struct Past
   {
      std::array<mfem::real_t, 2> time{{0.0, 0.0}};
      std::array<mfem::Vector, 2> multiplier;
      std::array<mfem::Vector, 2> flux_multiplier;
   };
   Past stored;
   Past accepted;
   /// Factors by which the penalties were raised, of gap and pressure jump.
   struct Stiffening
   {
      mfem::real_t gap = 1.0;
      mfem::real_t jump = 1.0;
   };
   Stiffening stiffening;
   Stiffening accepted_stiffening;
   /// Violations at the last augmentation.
   mfem::real_t last_penetration = 0.0;
   mfem::real_t last_jump = 0.0;
   std::array<mfem::Vector, 10> accepted_vectors;
   /// What is added to the gaps, see InitialOverlap::remove.
   mfem::Vector removed_overlap;
   mfem::Vector gap;
   mfem::Vector jump;
   /// Of the destination, mean around its vertices.
   mfem::Vector pressure;
   mfem::Vector traction;
   mfem::Vector flux;
   mfem::Vector active;
   mfem::Vector sealing;
   mfem::Vector gap_weights;
   mfem::Vector jump_weights;
};

} // namespace synovia
