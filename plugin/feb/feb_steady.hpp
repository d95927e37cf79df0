#pragma once

#include "synovia/feb/feb_model.hpp"

namespace synovia
{

/// Makes each step of the model end in a steady state: pressures of one depend
/// on ratios of permeabilities only, unless a flux is prescribed, so that all
/// of them are multiplied by a factor with which fluid takes a small part of
/// the shortest step. Returns the factor.
mfem::real_t MakeSteady(FebModel &model);

} // namespace synovia
