// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/splitting/compact_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "mesh/cell_geometry.h"
#include "problem/barycentric_constraints.h"
#include "problem/boundary_flux.h"

namespace flbc::compact {
namespace {

// Interior vertices in the order of the factor, then the boundary.
template <class Scalar, int Dim>
void set_up_rows(const LbcProblem<Dim>& problem, const splitting::Metric& metric,
                 const std::vector<Index>& position, CompactData<Scalar, Dim>& data) {
  data.vertices.resize(position.size());
  data.row_of.resize(problem.mesh.num_vertices());
  Index unknown = 0;
  for (const Index v : problem.boundary.interior_vertices()) {
    data.row_of[v] = position[unknown++];
    data.vertices[data.row_of[v]] = v;
  }
  for (std::size_t b = 0; b < problem.boundary.vertices.size(); ++b) {
    data.row_of[problem.boundary.vertices[b]] = static_cast<Index>(position.size() + b);
  }
  if (metric.vertex.size() == 0) return;
  for (const Index v : data.vertices) {
    data.vertex_metric.push_back(static_cast<Scalar>(metric.vertex[v]));
  }
}

// Moves interior corners to the front, in their order; std::stable_partition would allocate memory.
template <std::size_t N, class Predicate>
void inner_first(std::array<int, N>& corners, const Predicate& is_inside) {
  auto end = corners.begin();
  for (auto corner = corners.begin(); corner != corners.end(); ++corner) {
    if (is_inside(*corner)) std::rotate(end++, corner, corner + 1);
  }
}

// Cells with all corners on the boundary do not affect the weights.
template <class Scalar, int Dim>
void set_up_cells(const LbcProblem<Dim>& problem, const splitting::Metric& metric,
                  CompactData<Scalar, Dim>& data) {
  const auto num_interior = static_cast<Index>(data.vertices.size());
  const auto row_of = [&](int k, Index s) { return data.row_of[problem.mesh.cells(k, s)]; };
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    if (!is_boundary_cell(problem, s)) data.cell_index.push_back(s);
  }
  data.cells.resize(data.cell_index.size());
  parallel_for(data.cells.size(), [&](std::size_t place) {
    const Index s = data.cell_index[place];
    std::array<int, Dim + 1> corners;
    std::iota(corners.begin(), corners.end(), 0);
    inner_first(corners, [&](int k) { return row_of(k, s) < num_interior; });
    const auto hats = cell_geometry(problem.mesh, s).hat_gradients;
    const double root = std::sqrt(metric.cell[s]);
    auto& cell = data.cells[place];
    for (int k = 0; k <= Dim; ++k) {
      cell.rows[k] = row_of(corners[k], s);
      for (int d = 0; d < Dim; ++d) {
        cell.hats[k][d] = static_cast<Scalar>(root * hats(d, corners[k]));
      }
    }
  });
}

}  // namespace

template <int Dim>
double radius_unit(const LbcProblem<Dim>& problem, const splitting::Metric& metric) {
  constexpr double kTypical = 8;
  constexpr double kLargest = 1000;
  const Eigen::ArrayXd radii2 = cell_measures(problem.mesh).array().square() / metric.cell.array();
  return std::min(kTypical / std::sqrt(radii2.mean()), kLargest / std::sqrt(radii2.maxCoeff()));
}

template <class Scalar, int Dim>
CompactData<Scalar, Dim> make_rows_and_cells(const LbcProblem<Dim>& problem,
                                             const splitting::Metric& metric,
                                             const std::vector<Index>& position) {
  CompactData<Scalar, Dim> data;
  set_up_rows(problem, metric, position, data);
  set_up_cells(problem, metric, data);
  return data;
}

template <class Scalar, int Dim>
void set_constraints(const LbcProblem<Dim>& problem, std::size_t stride,
                     CompactData<Scalar, Dim>& data) {
  const BarycentricConstraints<Dim> constraints(problem.cage.points);
  data.basis = AlignedArray<Scalar>((Dim + 1) * stride);
  for (int k = 0; k <= Dim; ++k) {
    for (Index i = 0; i < problem.num_control_points(); ++i) {
      data.basis[k * stride + i] = static_cast<Scalar>(constraints.basis()(i, k));
    }
  }
  for (const Index v : data.vertices) {
    for (const double number : constraints.weight_target(problem.mesh.points.col(v))) {
      data.row_target.push_back(static_cast<Scalar>(number));
    }
  }
}

FLBC_INSTANTIATE_FUNCTION(radius_unit)
FLBC_INSTANTIATE_SCALAR_FUNCTION(make_rows_and_cells)
FLBC_INSTANTIATE_SCALAR_FUNCTION(set_constraints)

}  // namespace flbc::compact
