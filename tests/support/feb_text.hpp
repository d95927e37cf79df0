#pragma once

#include <string>

namespace synovia
{

/// A model of FEBio, format 4.0: a column of two hexahedra of edge 1, pressed
/// from the top, which drains, by a traction that steps on.
std::string FebColumn();

/// The same column under a rigid plate, a shell that touches nothing yet and is
/// pressed down by a force.
std::string FebPressedColumn();

/// The same column, fed by vessels, with a table to be logged. At a side it
/// keeps to a plane by contact with a fixed rigid shell that bears tension, and
/// an edge has a condition of its own.
std::string FebGuidedColumn();

/// The column under the plate, with fibers that the mesh has directions of, a
/// side that constraints of its nodes hold, a joint beside the plate, and steps
/// that press it and hold it.
std::string FebSteppedColumn();

/// The text with the first @a old replaced, which must be in it.
std::string Replaced(const std::string &text, const std::string &old,
                     const std::string &other);

/// The line, from 1, in which the text first has @a part.
int LineOf(const std::string &text, const std::string &part);

} // namespace synovia
