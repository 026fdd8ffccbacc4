// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/splitting/metric.h"

#include <algorithm>

#include "mesh/cell_geometry.h"
#include "problem/barycentric_constraints.h"
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

template <class Scalar, int Dim>
RowConstraints<Scalar, Dim> row_constraints(const LbcProblem<Dim>& problem,
                                            const std::vector<Index>& vertices,
                                            std::size_t stride) {
  const BarycentricConstraints<Dim> constraints(problem.cage.points);
  RowConstraints<Scalar, Dim> rows;
  rows.basis = AlignedArray<Scalar>((Dim + 1) * stride);
  for (int k = 0; k <= Dim; ++k) {
    for (Index i = 0; i < problem.num_control_points(); ++i) {
      rows.basis[k * stride + i] = static_cast<Scalar>(constraints.basis()(i, k));
    }
  }
  rows.target.resize(vertices.size() * (Dim + 1));
  for (std::size_t row = 0; row < vertices.size(); ++row) {
    Eigen::Map<Eigen::Matrix<Scalar, Dim + 1, 1>>(rows.target.data() + row * (Dim + 1)) =
        constraints.weight_target(problem.mesh.points.col(vertices[row])).template cast<Scalar>();
  }
  return rows;
}

#define FLBC_INSTANTIATE(Dim)                                                                  \
  template Metric measure_metric(const LbcProblem<Dim>&, bool);                                \
  template Metric squared_measure_metric(const LbcProblem<Dim>&, double);                      \
  template RowMatrix system_matrix(const LbcProblem<Dim>&, const Metric&);                     \
  template RowConstraints<float, Dim> row_constraints(const LbcProblem<Dim>&,                  \
                                                      const std::vector<Index>&, std::size_t); \
  template RowConstraints<double, Dim> row_constraints(const LbcProblem<Dim>&,                 \
                                                       const std::vector<Index>&, std::size_t);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::splitting
