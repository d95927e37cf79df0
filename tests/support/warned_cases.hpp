#pragma once

#include "support/boxes.hpp"
#include "synovia/mesh/named_mesh.hpp"

#include <string>
#include <vector>

namespace synovia
{

/// A case of a layer, 10 x 10 x 2, under a block, 2 x 2 x 2: a quarter. It
/// draws no warning on PressedLayer().
extern const std::string pressed_layer;

/// The same with a force of 0.2 on the block's top.
std::string PressedByForce();

/// Their boxes, and the mesh of both, scaled.
BoxOptions LayerOptions();
BoxOptions BlockOptions();
NamedMesh PressedLayer(mfem::real_t scale = 1.0);
/// Lifts the upper one of two boxes, of which the lower one has LayerOptions().
void LiftBlock(mfem::real_t height, mfem::Mesh &mesh);

/// A case of a flat quarter of a disc, "body", which is pressed by its top and
/// drains at its side; the plane of symmetry y0 has no condition.
extern const std::string pressed_disc;
/// Of radius 1.5 and height 0.25.
NamedMesh PressedDisc();

/// The text with one part of it replaced, or taken out. The test fails if it
/// isn't there.
std::string Replaced(std::string text, const std::string &from,
                     const std::string &to);
std::string Without(std::string text, const std::vector<std::string> &parts);

/// Lines of a text, which is the same on all ranks, or the test fails.
/// Collective.
std::string Joined(const std::vector<std::string> &lines);
std::string OnAllRanks(const std::string &text);

/// What FindWarnings() says of a case, a line each; on PressedLayer() unless
/// there is a mesh. Collective.
std::string WarningsOf(const std::string &text, NamedMesh &mesh);
std::string WarningsOf(const std::string &text);

/// Fails the test unless there is one line, which contains these texts.
void CheckOneWarning(const std::string &warnings,
                     const std::vector<std::string> &texts);

} // namespace synovia
