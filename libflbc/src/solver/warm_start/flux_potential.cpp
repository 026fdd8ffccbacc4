// SPDX-License-Identifier: BSD-3-Clause
#include "solver/warm_start/flux_potential.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "mesh/cell_geometry.h"

namespace flbc {
namespace {

template <int Dim>
using Vectors = Eigen::Matrix<double, Eigen::Dynamic, Dim>;

template <int Dim>
Vector<Dim> corner(const LbcProblem<Dim>& problem, Index facet, int k) {
  return problem.mesh.points.col(problem.topology.facets(k, facet));
}

// Out of the facet's first cell, as long as the facet is large.
template <int Dim>
Vector<Dim> area_normal(const LbcProblem<Dim>& problem, Index facet) {
  const Vector<Dim> first = corner(problem, facet, 0);
  const Vector<Dim> edge = corner(problem, facet, 1) - first;
  Vector<Dim> normal;
  if constexpr (Dim == 2) {
    normal << edge.y(), -edge.x();
  } else {
    normal = edge.cross(corner(problem, facet, 2) - first) / 2;
  }
  const Index cell = problem.topology.sides(0, facet);
  const Vector<Dim> inside = centroid(problem.mesh.points, problem.mesh.cells, cell);
  return normal.dot(inside - first) > 0 ? Vector<Dim>(-normal) : normal;
}

// Counter-clockwise round the first cell, as long as the edge.
Vector<2> edge_vector(const LbcProblem<2>& problem, Index edge) {
  const Vector<2> normal = area_normal(problem, edge);
  return {-normal.y(), normal.x()};
}

// a x b for each row b.
Vectors<3> cross_rows(const Vector<3>& a, const Vectors<3>& rows) {
  Eigen::Matrix3d matrix;
  matrix << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return rows * matrix.transpose();
}

// Adds the normal components that the multipliers leave open.
void complete_normals(const LbcProblem<3>& problem, Eigen::MatrixXd& potential) {
  const auto& topology = problem.topology;
  Eigen::MatrixXd normal_parts = Eigen::MatrixXd::Zero(potential.rows(), topology.num_facets());
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    Vectors<3> sum = Vectors<3>::Zero(potential.rows(), 3);
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    for (int k = 0; k <= 3; ++k) {
      const Index f = topology.cell_facets(k, s);
      const Vector<3> normal = area_normal(problem, f).normalized();
      matrix += Eigen::Matrix3d::Identity() - normal * normal.transpose();
      sum += potential.middleCols<3>(Eigen::Index{3} * f);
    }
    // The four normals of a cell span space: the matrix is far from singular.
    const Vectors<3> constant = sum * matrix.inverse();
    for (int k = 0; k <= 3; ++k) {
      const Index f = topology.cell_facets(k, s);
      const double share = topology.is_boundary(f) ? 1 : 0.5;
      normal_parts.col(f) += share * constant * area_normal(problem, f).normalized();
    }
  }
  for (Index f = 0; f < topology.num_facets(); ++f) {
    potential.middleCols<3>(Eigen::Index{3} * f) +=
        normal_parts.col(f) * area_normal(problem, f).normalized().transpose();
  }
}

}  // namespace

template <int Dim>
Eigen::MatrixXd flux_potential(const LbcProblem<Dim>& problem, const VectorsAt<Dim>& multipliers) {
  constexpr int kSize = MeshState<Dim>::kPotentialSize;
  const Index num_facets = problem.topology.num_facets();
  Eigen::MatrixXd potential(problem.num_control_points(), Eigen::Index{kSize} * num_facets);
#pragma omp parallel for schedule(static)
  for (Index f = 0; f < num_facets; ++f) {
    if constexpr (Dim == 2) {
      const Vector<2> edge = edge_vector(problem, f);
      potential.col(f) = multipliers(f) * edge / edge.squaredNorm();
    } else {
      const Vector<3> normal = area_normal(problem, f);
      potential.middleCols<3>(Eigen::Index{3} * f) =
          cross_rows(-normal / normal.squaredNorm(), multipliers(f));
    }
  }
  if constexpr (Dim == 3) complete_normals(problem, potential);
  return potential;
}

template <int Dim>
Eigen::MatrixXd evaluate_potential(const LbcProblem<Dim>& problem, const Eigen::MatrixXd& potential,
                                   const Location<Dim>& place) {
  constexpr int kSize = MeshState<Dim>::kPotentialSize;
  Eigen::MatrixXd value = Eigen::MatrixXd::Zero(potential.rows(), kSize);
  for (int k = 0; k <= Dim; ++k) {
    const Index facet = problem.topology.cell_facets(k, place.cell);
    value += (1 - Dim * place.coordinates[k]) * potential.template middleCols<kSize>(kSize * facet);
  }
  return value;
}

template <int Dim>
Eigen::Matrix<double, Eigen::Dynamic, Dim> facet_multiplier(const LbcProblem<Dim>& problem,
                                                            Index facet,
                                                            const Eigen::MatrixXd& potential) {
  if constexpr (Dim == 2) {
    return potential * edge_vector(problem, facet).transpose();
  } else {
    return cross_rows(area_normal(problem, facet), potential);
  }
}

#define FLBC_INSTANTIATE(Dim)                                                                 \
  template Eigen::MatrixXd flux_potential(const LbcProblem<Dim>&, const VectorsAt<Dim>&);     \
  template Eigen::MatrixXd evaluate_potential(const LbcProblem<Dim>&, const Eigen::MatrixXd&, \
                                              const Location<Dim>&);                          \
  template Eigen::Matrix<double, Eigen::Dynamic, Dim> facet_multiplier(                       \
      const LbcProblem<Dim>&, Index, const Eigen::MatrixXd&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
