// SPDX-License-Identifier: BSD-3-Clause
// The heat method: Crane, Weischedel, Wardetzky, "Geodesics in Heat", 2013.
#include "flbc/distance_weights.h"

#include <cmath>

#include "cell_geometry.h"
#include "laplacian.h"

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

// One short step of heat flow from every source. \return V x #sources
Eigen::MatrixXd heat(const Eigen::SparseMatrix<double>& stiffness, const Eigen::VectorXd& mass,
                     double time, const std::vector<Index>& sources) {
  const SpdSolver solver(time * stiffness + diagonal_matrix(mass));
  Eigen::MatrixXd impulse = Eigen::MatrixXd::Zero(mass.size(), sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i) impulse(sources[i], i) = 1;
  return solver.solve(impulse);
}

// Divergence of the normalised, reversed temperature gradient, in place of the temperature.
template <int Dim>
void replace_by_divergence_of_direction(const DomainMesh<Dim>& mesh, Eigen::MatrixXd& field) {
  std::vector<CellGeometry<Dim>> cells;
  cells.reserve(mesh.num_cells());
  for (Index s = 0; s < mesh.num_cells(); ++s) cells.push_back(cell_geometry(mesh, s));
#pragma omp parallel for schedule(static)
  for (Eigen::Index i = 0; i < field.cols(); ++i) {
    Eigen::VectorXd divergence = Eigen::VectorXd::Zero(mesh.num_vertices());
    for (Index s = 0; s < mesh.num_cells(); ++s) {
      Eigen::Matrix<double, Dim + 1, 1> temperature;
      for (int k = 0; k <= Dim; ++k) temperature[k] = field(mesh.cells(k, s), i);
      // Far from the source the temperature is near the smallest numbers: scale before squaring.
      const double largest = temperature.cwiseAbs().maxCoeff();
      if (!(largest > 0)) continue;
      const Vector<Dim> gradient = cells[s].hat_gradients * (temperature / largest);
      const double length = gradient.norm();
      if (!(length > 0)) continue;
      const Vector<Dim> flow = -cells[s].measure / length * gradient;
      for (int k = 0; k <= Dim; ++k) {
        divergence[mesh.cells(k, s)] += cells[s].hat_gradients.col(k).dot(flow);
      }
    }
    field.col(i) = divergence;
  }
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
  Eigen::MatrixXd field = heat(stiffness, mass, step * step, sources);
  replace_by_divergence_of_direction(mesh, field);

  // Constants are in the kernel of the stiffness matrix; a trace of mass makes it definite without
  // a visible change, because the right-hand side sums to zero.
  const double extent =
      (mesh.points.rowwise().maxCoeff() - mesh.points.rowwise().minCoeff()).norm();
  const SpdSolver solver(stiffness + 1e-8 / (extent * extent) * diagonal_matrix(mass));
  field = solver.solve(field);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    field.col(i) = (field.col(i).array() - field(sources[i], i)).max(0.0);
  }
  return field.transpose();
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
