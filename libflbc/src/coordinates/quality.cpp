// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/quality.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/shape_checks.h"
#include "flbc/bounding_box.h"
#include "mesh/cell_geometry.h"

namespace flbc {
namespace {

// sum_s A_s f(s, |grad w|_s), where |grad w|_s has an entry per control point.
template <int Dim, class Function>
double integrate_gradient_lengths(const DomainMesh<Dim>& mesh, const WeightMatrix& weights,
                                  const Function& function) {
  return parallel_sum(mesh.num_cells(), 0.0, [&](Index begin, Index end) {
    double sum = 0;
    for (Index s = begin; s < end; ++s) {
      const auto geometry = cell_geometry(mesh, s);
      const auto gradients = weight_gradients(mesh, s, geometry, weights);
      sum += geometry.measure * function(s, gradients.rowwise().norm());
    }
    return sum;
  });
}

}  // namespace

template <int Dim>
Quality measure_quality(const PointList<Dim>& control_points, const PointList<Dim>& points,
                        const WeightMatrix& weights) {
  check_size(weights, control_points.cols(), points.cols());
  const double size = bounding_box_diagonal(control_points);
  Quality quality;
  quality.min_weight = weights.size() > 0 ? weights.minCoeff() : 0;
  Index influences = 0;
  for (Eigen::Index v = 0; v < points.cols(); ++v) {
    const auto column = weights.col(v);
    const Vector<Dim> error = control_points * column - points.col(v);
    quality.max_partition_error = std::max(quality.max_partition_error, std::abs(column.sum() - 1));
    quality.max_reproduction_error = std::max(quality.max_reproduction_error, error.norm() / size);
    influences += static_cast<Index>((column.array().abs() > kInfluenceThreshold).count());
  }
  quality.mean_influences = static_cast<double>(influences) /
                            static_cast<double>(std::max<Eigen::Index>(1, points.cols()));
  return quality;
}

template <int Dim>
double objective(const DomainMesh<Dim>& mesh, const WeightFunctions& phi,
                 const WeightMatrix& weights) {
  return integrate_gradient_lengths(
      mesh, weights, [&](Index s, const auto& lengths) { return phi.col(s).dot(lengths); });
}

template <int Dim>
double total_variation(const DomainMesh<Dim>& mesh, const WeightMatrix& weights) {
  return integrate_gradient_lengths(mesh, weights,
                                    [](Index, const auto& lengths) { return lengths.sum(); });
}

template <int Dim>
double squared_error(const LbcProblem<Dim>& problem, const WeightMatrix& a, const WeightMatrix& b) {
  check_size(a, problem.num_control_points(), problem.mesh.num_vertices());
  check_size(b, problem.num_control_points(), problem.mesh.num_vertices());
  double sum = 0;
  const auto interior = problem.boundary.interior_vertices();
  for (const Index v : interior) sum += (a.col(v) - b.col(v)).squaredNorm();
  if (interior.empty()) return 0;
  return sum / (static_cast<double>(interior.size()) * static_cast<double>(a.rows()));
}

#define FLBC_INSTANTIATE(Dim)                                                                     \
  template Quality measure_quality(const PointList<Dim>&, const PointList<Dim>&,                  \
                                   const WeightMatrix&);                                          \
  template double objective(const DomainMesh<Dim>&, const WeightFunctions&, const WeightMatrix&); \
  template double total_variation(const DomainMesh<Dim>&, const WeightMatrix&);                   \
  template double squared_error(const LbcProblem<Dim>&, const WeightMatrix&, const WeightMatrix&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
