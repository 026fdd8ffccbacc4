// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/bounding_box.h"

namespace flbc {

template <int Dim>
double bounding_box_diagonal(const PointList<Dim>& points) {
  if (points.cols() == 0) return 0;
  return (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).stableNorm();
}

template double bounding_box_diagonal<2>(const PointList<2>&);
template double bounding_box_diagonal<3>(const PointList<3>&);

}  // namespace flbc
