// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/splitting/metric.h"

#include "base/instantiate.h"
#include "mesh/cell_geometry.h"
#include "problem/laplacian.h"

namespace flbc::splitting {

template <int Dim>
Metric measure_metric(const LbcProblem<Dim>& problem, bool non_negative) {
  Metric metric;
  metric.cell = cell_measures(problem.mesh);
  if (non_negative) metric.vertex = plan::kVertexWeight * lumped_mass(problem.mesh);
  return metric;
}

template <int Dim>
Metric squared_measure_metric(const LbcProblem<Dim>& problem, double vertex_weight) {
  Metric metric;
  metric.cell = cell_measures(problem.mesh).cwiseAbs2();
  if (vertex_weight > 0) {
    metric.vertex = Eigen::VectorXd::Constant(problem.mesh.num_vertices(), vertex_weight);
  }
  return metric;
}

template <int Dim>
RowMatrix system_matrix(const LbcProblem<Dim>& problem, const Metric& metric) {
  const auto interior = problem.boundary.interior_vertices();
  auto matrix = stiffness_matrix(problem.mesh, metric.cell, interior);
  if (metric.vertex.size() == 0) return matrix;
  for (std::size_t row = 0; row < interior.size(); ++row) {
    matrix.coeffRef(row, row) += metric.vertex[interior[row]];
  }
  return matrix;
}

FLBC_INSTANTIATE_FUNCTION(measure_metric)
FLBC_INSTANTIATE_FUNCTION(squared_measure_metric)
FLBC_INSTANTIATE_FUNCTION(system_matrix)

}  // namespace flbc::splitting
