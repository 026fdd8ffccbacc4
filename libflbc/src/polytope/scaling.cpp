// SPDX-License-Identifier: BSD-3-Clause
#include "polytope/scaling.h"

#include <algorithm>
#include <limits>

#include "flbc/bounding_box.h"

namespace flbc {

template <int Dim>
double scale_of(const PointList<Dim>& control_points) {
  return std::max(bounding_box_diagonal<Dim>(control_points), std::numeric_limits<double>::min());
}

template double scale_of(const PointList<2>&);
template double scale_of(const PointList<3>&);

}  // namespace flbc
