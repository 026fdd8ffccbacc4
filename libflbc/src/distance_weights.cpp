// SPDX-License-Identifier: BSD-3-Clause
// The heat method: Crane, Weischedel, Wardetzky, "Geodesics in Heat", 2013.
#include "flbc/distance_weights.h"

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "aligned_array.h"
#include "cell_geometry.h"
#include "laplacian.h"
#include "linear/panel_cholesky.h"

namespace flbc {
namespace {

template <int Dim>
double mean_edge_length(const DomainMesh<Dim>& mesh) {
  double sum = 0;
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    for (int a = 0; a < Dim; ++a) {
      for (int b = a + 1; b <= Dim; ++b) {
        sum += (mesh.points.col(mesh.cells(a, s)) - mesh.points.col(mesh.cells(b, s))).norm();
      }
    }
  }
  return sum / (0.5 * Dim * (Dim + 1) * mesh.num_cells());
}

Eigen::SparseMatrix<double> diagonal_matrix(const Eigen::VectorXd& diagonal) {
  Eigen::SparseMatrix<double> matrix(diagonal.size(), diagonal.size());
  matrix.reserve(Eigen::VectorXi::Ones(diagonal.size()));
  for (Eigen::Index v = 0; v < diagonal.size(); ++v) matrix.insert(v, v) = diagonal[v];
  return matrix;
}

// A function per source on the vertices: a row per vertex, in the order of the solver it is for.
struct Field {
  std::vector<Index> position;  // row of a vertex
  std::size_t stride;
  AlignedArray<double> rows;

  Field(const PanelCholesky<double>& solver, std::size_t num_sources)
      : position(solver.position()),
        stride(row_stride(num_sources)),
        rows(solver.size() * stride) {}
  double* row(Index v) { return rows.data() + position[v] * stride; }
  const double* row(Index v) const { return rows.data() + position[v] * stride; }
};

// One short step of heat flow from every source.
Field heat(const Eigen::SparseMatrix<double>& stiffness, const Eigen::VectorXd& mass, double time,
           const std::vector<Index>& sources) {
  const PanelCholesky<double> solver(time * stiffness + diagonal_matrix(mass));
  Field field(solver, sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i) field.row(sources[i])[i] = 1;
  solver.solve(field.rows.data(), field.stride);
  return field;
}

// Adds one cell's part of the divergence of the normalised, reversed temperature gradient.
template <int Dim>
void add_divergence_of_direction(const CellGeometry<Dim>& cell,
                                 const std::array<const double*, Dim + 1>& temperature,
                                 const std::array<double*, Dim + 1>& divergence, Slice slice) {
  // Fixed numbers of columns side by side, without branches, so that the compiler vectorises.
  constexpr std::size_t kLanes = 8;
  for (std::size_t i = slice.begin; i < slice.end; i += kLanes) {
    // Far from the source the temperature is near the smallest numbers: scale before squaring.
    double largest[kLanes] = {};
    for (int k = 0; k <= Dim; ++k) {
      for (std::size_t l = 0; l < kLanes; ++l) {
        largest[l] = std::max(largest[l], std::abs(temperature[k][i + l]));
      }
    }
    for (std::size_t l = 0; l < kLanes; ++l) largest[l] = largest[l] > 0 ? largest[l] : 1.0;
    double gradient[Dim][kLanes] = {};
    for (int k = 0; k <= Dim; ++k) {
      for (std::size_t l = 0; l < kLanes; ++l) {
        const double scaled = temperature[k][i + l] / largest[l];
        for (int d = 0; d < Dim; ++d) gradient[d][l] += cell.hat_gradients(d, k) * scaled;
      }
    }
    double scale[kLanes];
    for (std::size_t l = 0; l < kLanes; ++l) {
      double length2 = 0;
      for (int d = 0; d < Dim; ++d) length2 += gradient[d][l] * gradient[d][l];
      scale[l] = length2 > 0 ? -cell.measure / std::sqrt(length2) : 0.0;
    }
    for (int k = 0; k <= Dim; ++k) {
      for (std::size_t l = 0; l < kLanes; ++l) {
        double share = 0;
        for (int d = 0; d < Dim; ++d) share += cell.hat_gradients(d, k) * gradient[d][l];
        divergence[k][i + l] += scale[l] * share;
      }
    }
  }
}

// Every thread adds up the columns of its own.
template <int Dim>
void add_divergence_of_direction(const DomainMesh<Dim>& mesh, const Field& temperature,
                                 Field& divergence) {
  std::vector<CellGeometry<Dim>> cells;
  cells.reserve(mesh.num_cells());
  for (Index s = 0; s < mesh.num_cells(); ++s) cells.push_back(cell_geometry(mesh, s));
#pragma omp parallel
  {
    const Slice slice = slice_of(temperature.stride, omp_get_thread_num(), omp_get_num_threads());
    for (Index s = 0; s < mesh.num_cells(); ++s) {
      std::array<const double*, Dim + 1> from;
      std::array<double*, Dim + 1> to;
      for (int k = 0; k <= Dim; ++k) {
        from[k] = temperature.row(mesh.cells(k, s));
        to[k] = divergence.row(mesh.cells(k, s));
      }
      add_divergence_of_direction<Dim>(cells[s], from, to, slice);
    }
  }
}

// The solution up to a constant, made zero at the source.
Eigen::MatrixXd distances_from(const Field& field, const std::vector<Index>& sources) {
  const auto n = static_cast<Eigen::Index>(sources.size());
  Eigen::ArrayXd at_source(n);
  for (Eigen::Index i = 0; i < n; ++i) at_source[i] = field.row(sources[i])[i];
  Eigen::MatrixXd distances(n, field.position.size());
  for (Eigen::Index v = 0; v < distances.cols(); ++v) {
    const Eigen::Map<const Eigen::ArrayXd> row(field.row(static_cast<Index>(v)), n);
    distances.col(v) = (row - at_source).max(0.0);
  }
  return distances;
}

double relative_to_weight(DistanceScheme scheme, double distance) {
  switch (scheme) {
    case DistanceScheme::kSquare:
      return distance * distance;
    case DistanceScheme::kLinear:
      return distance;
    case DistanceScheme::kSquareRoot:
      return std::sqrt(distance);
    case DistanceScheme::kConstant:
      break;
  }
  return 1;
}

}  // namespace

template <int Dim>
Eigen::MatrixXd geodesic_distances(const DomainMesh<Dim>& mesh, const std::vector<Index>& sources) {
  const auto stiffness = stiffness_matrix(mesh);
  const auto mass = lumped_mass(mesh);
  const double step = mean_edge_length(mesh);
  const Field temperature = heat(stiffness, mass, step * step, sources);

  // Constants are in the kernel of the stiffness matrix; a trace of mass makes it definite without
  // a visible change, because the right-hand side sums to zero.
  const double extent =
      (mesh.points.rowwise().maxCoeff() - mesh.points.rowwise().minCoeff()).norm();
  const PanelCholesky<double> solver(stiffness + 1e-8 / (extent * extent) * diagonal_matrix(mass));

  Field field(solver, sources.size());
  add_divergence_of_direction(mesh, temperature, field);
  solver.solve(field.rows.data(), field.stride);
  return distances_from(field, sources);
}

template <int Dim>
Eigen::MatrixXd distance_weights(DistanceScheme scheme, const Eigen::MatrixXd& distances,
                                 const DomainMesh<Dim>& mesh, Index num_control_points) {
  if (scheme == DistanceScheme::kConstant) {
    return Eigen::MatrixXd::Ones(num_control_points, mesh.num_cells());
  }
  const double scale = 1 / ((Dim + 1) * distances.maxCoeff());
  Eigen::MatrixXd weights(num_control_points, mesh.num_cells());
#pragma omp parallel for schedule(static)
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    weights.col(s).setZero();
    for (int k = 0; k <= Dim; ++k) weights.col(s) += distances.col(mesh.cells(k, s));
    for (Index i = 0; i < num_control_points; ++i) {
      weights(i, s) = relative_to_weight(scheme, scale * weights(i, s));
    }
  }
  return weights;
}

#define FLBC_INSTANTIATE(Dim)                                                                     \
  template Eigen::MatrixXd geodesic_distances(const DomainMesh<Dim>&, const std::vector<Index>&); \
  template Eigen::MatrixXd distance_weights(DistanceScheme, const Eigen::MatrixXd&,               \
                                            const DomainMesh<Dim>&, Index);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
