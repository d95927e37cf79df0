#pragma once

#include "synovia/contact/contact_surface.hpp"
#include "synovia/contact/sliding_maps.hpp"
#include "synovia/general/state_archive.hpp"

#include <vector>

namespace synovia
{

/// How a vertex of the destination that bears traction is held along the
/// surface.
struct VertexSlip
{
   /// It slides, and bears the largest tangential traction that there is.
   bool slides = false;
   /// How often it went from sticking to sliding or back in this stage.
   int turns = 0;
   /// It turned too often: for the rest of the stage it sticks elastically, and
   /// yields where it slides.
   bool elastic = false;
   /// It slid, and its slip turned round: it sticks for an iteration.
   bool turned_round = false;
   /// Its limit is that of the last decision, as its gap is far from closed.
   bool lags = false;
};

/// The variables of friction that a step changes, for each of this rank's
/// vertices of the destination; without vertices where there is no friction.
/// Tangential tractions have the sign of the slip that they resist: they act
/// on the destination as they are, and on the source against it.
struct FrictionState
{
   explicit FrictionState(int vertices_);

   /// Lists what outlasts a step, with names that begin with @a prefix.
   /// Collective.
   void Archive(StateArchive &archive, const std::string &prefix,
                const ContactSurface &destination);

   static Point3 At(const VectorByComponent &values, int vertex)
   {
      return {values[0][vertex], values[1][vertex], values[2][vertex]};
   }
   static void Set(VectorByComponent &values, int vertex, const Point3 &value)
   {
      for (int c = 0; c < 3; c++)
      {
         values[c][vertex] = value[c];
      }
   }

   /// 1 for the vertices that slide, 0 for others.
   mfem::Vector Sliding() const;

   /// Multiplier (stress), across the normals at the beginning of a step.
   VectorByComponent multiplier;
   /// Tangential traction per undeformed area (stress).
   VectorByComponent traction;
   /// Of the source along the destination since the beginning of the step
   /// (length).
   VectorByComponent slip;
   /// Present unit normal of the destination, and its length before it was a
   /// unit vector: int phi_j n dA (area).
   VectorByComponent normal;
   mfem::Vector normal_length;
   /// Mean motion that SlidingMaps follow since the beginning of the step, and
   /// pressure per undeformed area; see SlidingMaps.
   VectorByComponent distance;
   mfem::Vector pressure;
   std::vector<VertexSlip> vertices;
   /// Work of friction at this rank's vertices since the run began.
   mfem::real_t dissipation = 0.0;
};

} // namespace synovia
