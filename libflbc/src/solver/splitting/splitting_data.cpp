// SPDX-License-Identifier: BSD-3-Clause
#include "solver/splitting/splitting_data.h"

#include <algorithm>

#include "flbc/bounding_box.h"
#include "mesh/cell_geometry.h"
#include "problem/barycentric_constraints.h"
#include "problem/laplacian.h"

namespace flbc::splitting {

template <int Dim>
Metric measure_metric(const LbcProblem<Dim>& problem, bool non_negative) {
  // How firmly non-negativity is tied to the gradients: flat between 10 and 300.
  constexpr double kVertexWeight = 100;
  const double size = bounding_box_diagonal(problem.cage.points);
  Metric metric;
  metric.cell = cell_measures(problem.mesh);
  if (non_negative) metric.vertex = kVertexWeight / (size * size) * lumped_mass(problem.mesh);
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

namespace {

template <class Scalar, int Dim>
void set_up_rows(const LbcProblem<Dim>& problem, const Metric& metric,
                 const std::vector<Index>& position, SplittingData<Scalar, Dim>& data) {
  const auto boundary_row = static_cast<Index>(position.size());
  std::vector<Index> row_of(problem.mesh.num_vertices(), boundary_row);
  data.vertices.resize(boundary_row);
  Index unknown = 0;
  for (const Index v : problem.boundary.interior_vertices()) {
    row_of[v] = position[unknown++];
    data.vertices[row_of[v]] = v;
  }
  data.cell_rows.resize(problem.mesh.cells.size());
  for (std::size_t corner = 0; corner < data.cell_rows.size(); ++corner) {
    data.cell_rows[corner] = row_of[problem.mesh.cells.data()[corner]];
  }
  if (metric.vertex.size() == 0) return;
  for (const Index v : data.vertices) {
    data.vertex_metric.push_back(static_cast<Scalar>(metric.vertex[v]));
  }
}

template <class Scalar, int Dim>
void set_up_cells(const LbcProblem<Dim>& problem, const Metric& metric, const ColumnSlices& slices,
                  SplittingData<Scalar, Dim>& data) {
  const auto cells = static_cast<std::size_t>(problem.mesh.num_cells());
  const Index n = problem.num_control_points();
  // A cell's phi may be as good as zero, which must not take radii into the denormal range.
  constexpr double kSmallestPhi = 1e-10;
  data.phi = AlignedArray<Scalar>(cells * slices.stride());
  data.hat_gradients.resize(cells * Dim * Dim);
  data.cell_metric.resize(cells);
  data.measures.resize(cells);
  data.radius_scale.resize(cells);
#pragma omp parallel for schedule(static)
  for (std::size_t s = 0; s < cells; ++s) {
    const auto geometry = cell_geometry(problem.mesh, static_cast<Index>(s));
    Eigen::Map<Eigen::Matrix<Scalar, Dim, Dim>>(data.hat_gradients.data() + s * Dim * Dim) =
        geometry.hat_gradients.template rightCols<Dim>().template cast<Scalar>();
    data.measures[s] = static_cast<Scalar>(geometry.measure);
    data.cell_metric[s] = static_cast<Scalar>(metric.cell[s]);
    slices.for_each(s, cells, [&](std::size_t begin, std::size_t width, std::size_t place) {
      const auto end = std::min(static_cast<Index>(begin + width), n);
      for (auto i = static_cast<Index>(begin); i < end; ++i) {
        data.phi[place++] = static_cast<Scalar>(std::max(problem.phi(i, s), kSmallestPhi));
      }
    });
  }
}

}  // namespace

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

template <class Scalar, int Dim>
void SplittingData<Scalar, Dim>::set_radius_scale(const Metric& metric, double penalty) {
  for (std::size_t s = 0; s < radius_scale.size(); ++s) {
    radius_scale[s] = static_cast<Scalar>(static_cast<double>(measures[s]) /
                                          (penalty * metric.cell[static_cast<Index>(s)]));
  }
}

template <class Scalar, int Dim>
SplittingData<Scalar, Dim> make_splitting_data(const LbcProblem<Dim>& problem, const Metric& metric,
                                               const std::vector<Index>& position,
                                               const ColumnSlices& slices) {
  SplittingData<Scalar, Dim> data;
  set_up_rows(problem, metric, position, data);
  set_up_cells(problem, metric, slices, data);
  data.constraints = row_constraints<Scalar>(problem, data.vertices, slices.stride());
  return data;
}

#define FLBC_INSTANTIATE(Scalar, Dim)                                                           \
  template RowConstraints<Scalar, Dim> row_constraints(const LbcProblem<Dim>&,                  \
                                                       const std::vector<Index>&, std::size_t); \
  template struct SplittingData<Scalar, Dim>;                                                   \
  template SplittingData<Scalar, Dim> make_splitting_data(                                      \
      const LbcProblem<Dim>&, const Metric&, const std::vector<Index>&, const ColumnSlices&);
FLBC_INSTANTIATE(float, 2)
FLBC_INSTANTIATE(float, 3)
FLBC_INSTANTIATE(double, 2)
FLBC_INSTANTIATE(double, 3)
#undef FLBC_INSTANTIATE
template Metric measure_metric(const LbcProblem<2>&, bool);
template Metric measure_metric(const LbcProblem<3>&, bool);
template RowMatrix system_matrix(const LbcProblem<2>&, const Metric&);
template RowMatrix system_matrix(const LbcProblem<3>&, const Metric&);

}  // namespace flbc::splitting
