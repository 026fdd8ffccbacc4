// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Lines of vector formats, joined and thinned.
#pragma once

#include <vector>

#include "draw/primitives.h"

namespace flbc::draw {

//! Joins segments whose ends are bitwise the same to lines as long as possible, and leaves out
//! repeated segments and points that are nearly straight between their neighbours. The lines cover
//! what the segments cover, up to the tolerance.
//! \param tolerance  in the unit of the points
//! \return lines of at least one point; a closed one ends where it begins
std::vector<std::vector<Vector<2>>> join_segments(const std::vector<Segment>& segments,
                                                  double tolerance);

}  // namespace flbc::draw
