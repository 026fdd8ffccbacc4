// SPDX-License-Identifier: BSD-3-Clause
// Subdivides a surface, for meshers that preserve their input surface.
#pragma once

#include "flbc/cage.h"

namespace flbc {

//! Bisects triangles at the midpoints of their longest edges until no edge is longer than a given
//! length. Neighbors are divided consistently, so the surface stays closed. Control points keep
//! their indices and positions, and triangles their orientation.
//! \param longest  > 0, in the units of the cage
//! \param most_points  maximum number of points; needles can need millions, because each bisection
//! divides neighbors
//! \throws InputError if more points are needed
Cage<3> subdivide_surface(const Cage<3>& cage, double longest, std::size_t most_points);

}  // namespace flbc
