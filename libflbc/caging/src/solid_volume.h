// SPDX-License-Identifier: BSD-3-Clause
// The volume of a model that may be open or intersect itself.
#pragma once

#include "flbc/types.h"

namespace flbc {

//! Volume of the solid that triangles bound, within about a percent. Points count as inside if the
//! signed crossings of a line with the triangles before them do not add up to zero. Lines that pass
//! through an opening do not count. The result is the median of lines along x, y, and z.
//! \return 0 if the triangles bound nothing, or are oriented at random
double solid_volume(const PointList<3>& points, const FacetList<3>& facets);

}  // namespace flbc
