#pragma once

#include "synovia/cases/case_file.hpp"
#include "synovia/fem/body.hpp"

#include <array>
#include <vector>

namespace synovia
{

/// Along which axes contact can push a body, up and down, along which it has
/// loads, and along which a force drives it until it touches.
struct ContactGrip
{
   std::array<bool, 3> pushes_up{{false, false, false}};
   std::array<bool, 3> pushes_down{{false, false, false}};
   std::array<bool, 3> loaded{{false, false, false}};
   std::array<bool, 3> driven{{false, false, false}};
};

/// By body. Collective.
std::vector<ContactGrip> FindContactGrips(const CaseFile &setup,
                                          NamedMesh &mesh,
                                          const std::vector<Body> &bodies);

} // namespace synovia
