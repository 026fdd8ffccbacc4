// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/sparsify_error.h"

#include <algorithm>
#include <cmath>

#include "evaluation/weight_difference.h"
#include "flbc/deform.h"

namespace flbc {

Influences count_influences(const WeightMatrix& weights) {
  return count_influences(SparseWeights(weights));
}

Influences count_influences(const SparseWeights& weights) {
  if (weights.num_points() == 0) return {};
  Influences influences;
  for (Index p = 0; p < weights.num_points(); ++p) {
    const auto count = static_cast<Index>(weights.starts()[p + 1] - weights.starts()[p]);
    influences.max = std::max(influences.max, count);
  }
  influences.mean = static_cast<double>(weights.values().size()) / weights.num_points();
  return influences;
}

ErrorNorms weight_error(const WeightMatrix& before, const WeightMatrix& after) {
  return weight_error(SparseWeights(before), SparseWeights(after));
}

ErrorNorms weight_error(const SparseWeights& before, const SparseWeights& after) {
  const auto difference = difference_of(before, after);
  const Eigen::Map<const Eigen::VectorXd> values(
      difference.values().data(), static_cast<Eigen::Index>(difference.values().size()));
  if (values.size() == 0) return {};
  const double count = static_cast<double>(after.num_points()) * after.num_control_points();
  return {std::sqrt(values.squaredNorm() / count), values.cwiseAbs().maxCoeff()};
}

template <int Dim>
ErrorNorms deformation_error(const std::vector<PointList<Dim>>& poses, const WeightMatrix& before,
                             const WeightMatrix& after) {
  return deformation_error(poses, SparseWeights(before), SparseWeights(after));
}

template <int Dim>
ErrorNorms deformation_error(const std::vector<PointList<Dim>>& poses, const SparseWeights& before,
                             const SparseWeights& after) {
  const auto difference = difference_of(before, after);
  if (difference.num_points() == 0 || poses.empty()) return {};
  double sum = 0, max = 0;
  for (const auto& pose : poses) {
    const Eigen::VectorXd distances = deform<Dim>(difference, pose).colwise().norm();
    sum += distances.squaredNorm();
    max = std::max(max, distances.maxCoeff());
  }
  const double count =
      static_cast<double>(difference.num_points()) * static_cast<double>(poses.size());
  return {std::sqrt(sum / count), max};
}

#define FLBC_INSTANTIATE(Dim)                                                                     \
  template ErrorNorms deformation_error(const std::vector<PointList<Dim>>&, const WeightMatrix&,  \
                                        const WeightMatrix&);                                     \
  template ErrorNorms deformation_error(const std::vector<PointList<Dim>>&, const SparseWeights&, \
                                        const SparseWeights&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
