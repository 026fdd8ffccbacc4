// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string>

#include "cell_geometry.h"
#include "flbc/coordinates.h"
#include "flbc/errors.h"
#include "parallel.h"

namespace flbc {

template <int Dim>
Quality measure_quality(const PointList<Dim>& control_points, const PointList<Dim>& points,
                        const WeightMatrix& weights) {
  if (weights.rows() != control_points.cols() || weights.cols() != points.cols()) {
    throw InputError("weights for " + std::to_string(weights.cols()) + " points and " +
                     std::to_string(weights.rows()) + " control points do not belong to " +
                     std::to_string(points.cols()) + " points and " +
                     std::to_string(control_points.cols()) + " control points");
  }
  constexpr double kInfluence = 1e-4;
  const double size = size_of(control_points);
  Quality quality;
  quality.min_weight = weights.size() > 0 ? weights.minCoeff() : 0;
  Index influences = 0;
  for (Eigen::Index v = 0; v < points.cols(); ++v) {
    const auto column = weights.col(v);
    const Vector<Dim> error = control_points * column - points.col(v);
    quality.max_partition_error = std::max(quality.max_partition_error, std::abs(column.sum() - 1));
    quality.max_reproduction_error = std::max(quality.max_reproduction_error, error.norm() / size);
    influences += static_cast<Index>((column.array().abs() > kInfluence).count());
  }
  quality.mean_influences = static_cast<double>(influences) /
                            static_cast<double>(std::max<Eigen::Index>(1, points.cols()));
  return quality;
}

template <int Dim>
double objective(const DomainMesh<Dim>& mesh, const Eigen::MatrixXd& phi,
                 const WeightMatrix& weights) {
  return parallel_sum(mesh.num_cells(), 0.0, [&](Index begin, Index end) {
    double sum = 0;
    for (Index s = begin; s < end; ++s) {
      const auto geometry = cell_geometry(mesh, s);
      const auto gradients = weight_gradients(mesh, s, geometry, weights);
      sum += geometry.measure * phi.col(s).dot(gradients.rowwise().norm());
    }
    return sum;
  });
}

#define FLBC_INSTANTIATE(Dim)                                                    \
  template Quality measure_quality(const PointList<Dim>&, const PointList<Dim>&, \
                                   const WeightMatrix&);                         \
  template double objective(const DomainMesh<Dim>&, const Eigen::MatrixXd&, const WeightMatrix&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
