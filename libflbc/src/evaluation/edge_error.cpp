// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/edge_error.h"
#include "flbc/sparsify_error.h"

#include <algorithm>
#include <cmath>

#include "base/shape_checks.h"

namespace flbc {

template <int Dim>
ErrorNorms edge_error(const PointList<Dim>& points, const EdgeList& edges,
                      const std::vector<PointList<Dim>>& poses, const WeightMatrix& before,
                      const WeightMatrix& after) {
  check_size(before, before.rows(), points.cols());
  check_size(after, before.rows(), points.cols());
  check_poses<Dim>(poses, before.rows());
  validate(edges, points.cols());
  const WeightMatrix difference = after - before;
  double sum = 0, rest = 0;
  ErrorNorms norms;
  for (const auto& pose : poses) {
    const PointList<Dim> errors = pose * difference;
    for (std::size_t e = 0; e < edges.ends.size(); ++e) {
      const auto [a, b] = edges.ends[e];
      const double weight = edges.weights.empty() ? 1 : edges.weights[e];
      const double length = (points.col(a) - points.col(b)).norm();
      const double error = (errors.col(a) - errors.col(b)).norm();
      sum += weight * error * error;
      rest += weight * length * length;
      if (length > 0) norms.max = std::max(norms.max, error / length);
    }
  }
  if (rest > 0) norms.rms = std::sqrt(sum / rest);
  return norms;
}

#define FLBC_INSTANTIATE(Dim)                                                             \
  template ErrorNorms edge_error(const PointList<Dim>&, const EdgeList&,                  \
                                 const std::vector<PointList<Dim>>&, const WeightMatrix&, \
                                 const WeightMatrix&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
