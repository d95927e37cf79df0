#pragma once

#include "synovia/fem/biphasic_spaces.hpp"
#include "synovia/fem/moduli_ratios.hpp"
#include "synovia/fem/space_patterns.hpp"
#include "synovia/materials/material_table.hpp"

#include <memory>

namespace synovia
{

/// The matrices of the bodies, without boundary conditions, contact and time
/// step. For infinitesimal linear bodies they are constant.
struct VolumeMatrices
{
   /// Assembles all of them. Every element's attribute must have a material.
   VolumeMatrices(BiphasicSpaces &spaces, const MaterialTable &materials);
   /// The same with patterns of the spaces, which serve other matrices, too.
   VolumeMatrices(BiphasicSpaces &spaces, const MaterialTable &materials,
                  SpacePatterns &patterns);

   /// (C eps(u), eps(w)), displacement x displacement.
   std::shared_ptr<mfem::HypreParMatrix> stiffness;
   /// (div u, q) where there is fluid, as all that has pressures, pressure x
   /// displacement, and its transpose; in finite deformation the former has the
   /// change of the flow as well.
   std::shared_ptr<mfem::HypreParMatrix> divergence;
   std::shared_ptr<mfem::HypreParMatrix> divergence_transpose;
   /// (kappa grad p, grad q) + (kp p, q), pressure x pressure: flow, and what
   /// the pressure holds back of a FluidSupply.
   std::shared_ptr<mfem::HypreParMatrix> darcy;
   /// Pressure-projection stabilization for dp/dt; null where it isn't needed.
   std::shared_ptr<mfem::HypreParMatrix> stabilization;
   /// (p / H_A, q): what the solid adds to the Schur complement of the
   /// pressure.
   std::shared_ptr<mfem::HypreParMatrix> compliance;
   /// Whether stiffness is symmetric, and divergence_transpose no more than its
   /// name says.
   bool symmetric = true;
   ModuliRatios moduli;
   /// FindAnisotropy(); empty where all solids are isotropic.
   mfem::Vector anisotropy;
   /// Of the displacement.
   int order = 1;
   /// Whether any element of any rank is a tetrahedron.
   bool tetrahedra = false;
};

} // namespace synovia
