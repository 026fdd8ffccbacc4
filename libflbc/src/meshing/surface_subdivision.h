// SPDX-License-Identifier: BSD-3-Clause
// Finer triangles on the same surface, for meshers that keep the surface they are given.
#pragma once

#include "flbc/cage.h"

namespace flbc {

//! Bisects triangles at the middles of their longest edges until no edge is longer than a length;
//! neighbours are divided alike, so that the surface stays closed. The control points keep their
//! numbers and places, and the triangles their orientation.
//! \param longest  > 0, in the units of the cage
//! \param most_points  that are made; needles can take millions, as each division divides neighbours
//! \throws InputError if it takes more of them
Cage<3> subdivide_surface(const Cage<3>& cage, double longest, std::size_t most_points);

}  // namespace flbc
