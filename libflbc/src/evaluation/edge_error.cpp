// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/sparsify_error.h"

#include <algorithm>
#include <cmath>

#include "base/shape_checks.h"
#include "evaluation/weight_difference.h"
#include "flbc/deform.h"

namespace flbc {

template <int Dim>
ErrorNorms edge_error(const PointList<Dim>& points, const EdgeList& edges,
                      const std::vector<PointList<Dim>>& poses, const WeightMatrix& before,
                      const WeightMatrix& after) {
  check_size(before, before.rows(), points.cols());
  return edge_error(points, edges, poses, SparseWeights(before), SparseWeights(after));
}

template <int Dim>
ErrorNorms edge_error(const PointList<Dim>& points, const EdgeList& edges,
                      const std::vector<PointList<Dim>>& poses, const SparseWeights& before,
                      const SparseWeights& after) {
  check_poses<Dim>(poses, before.num_control_points());
  validate(edges, points.cols());
  const auto difference = difference_of(before, after);
  double sum = 0, rest = 0;
  ErrorNorms norms;
  for (const auto& pose : poses) {
    const auto errors = deform<Dim>(difference, pose);
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

#define FLBC_INSTANTIATE(Dim)                                                              \
  template ErrorNorms edge_error(const PointList<Dim>&, const EdgeList&,                   \
                                 const std::vector<PointList<Dim>>&, const WeightMatrix&,  \
                                 const WeightMatrix&);                                     \
  template ErrorNorms edge_error(const PointList<Dim>&, const EdgeList&,                   \
                                 const std::vector<PointList<Dim>>&, const SparseWeights&, \
                                 const SparseWeights&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
