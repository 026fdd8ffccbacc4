// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/gradient/constraint_data.h"

#include <Eigen/LU>

#include "base/instantiate.h"
#include "base/padded_rows.h"
#include "base/parallel.h"
#include "mesh/cell_geometry.h"
#include "problem/barycentric_constraints.h"

namespace flbc::gradient {
namespace {

// Orthonormal basis of the tangent space of the facet, one column per direction.
template <int Dim>
Eigen::Matrix<double, Dim, Dim - 1> tangent_basis(const LbcProblem<Dim>& problem, Index facet) {
  const auto point = [&](int k) {
    return problem.mesh.points.col(problem.topology.facets(k, facet));
  };
  Eigen::Matrix<double, Dim, Dim - 1> tangents;
  tangents.col(0) = (point(1) - point(0)).normalized();
  if constexpr (Dim == 3) {
    const Vector<3> edge = point(2) - point(0);
    tangents.col(1) = (edge - tangents.col(0) * tangents.col(0).dot(edge)).normalized();
  }
  return tangents;
}

// h of (9), n x (Dim - 1): the tangential derivatives of the boundary values.
template <int Dim>
Eigen::Matrix<double, Eigen::Dynamic, Dim - 1> boundary_slopes(
    const LbcProblem<Dim>& problem, Index facet,
    const Eigen::Matrix<double, Dim, Dim - 1>& tangents) {
  const auto corners = problem.topology.facets.col(facet);
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(problem.num_control_points(), Dim);
  Eigen::Matrix<double, Dim - 1, Dim - 1> edges;  // in tangent coordinates, one per column
  for (int k = 0; k < Dim; ++k) {
    problem.boundary.scatter(problem.boundary.boundary_index[corners[k]], weights.col(k));
    if (k == 0) continue;
    edges.col(k - 1) = tangents.transpose() *
                       (problem.mesh.points.col(corners[k]) - problem.mesh.points.col(corners[0]));
  }
  return (weights.template rightCols<Dim - 1>().colwise() - weights.col(0)) * edges.inverse();
}

template <class Scalar, int Dim>
void set_up_facets(const LbcProblem<Dim>& problem, Eigen::Index rows,
                   ConstraintData<Scalar, Dim>& data) {
  const auto& topology = problem.topology;
  const Eigen::Index num_boundary = (topology.sides.row(1).array() < 0).count();
  data.tangents.resize(topology.num_facets());
  data.boundary_index.assign(topology.num_facets(), -1);
  data.boundary_slope.setZero(rows, num_boundary * (Dim - 1));
  Index boundary = 0;
  for (Index f = 0; f < topology.num_facets(); ++f) {
    const auto tangents = tangent_basis(problem, f);
    data.tangents[f] = tangents.template cast<Scalar>();
    if (!topology.is_boundary(f)) continue;
    data.boundary_slope.block(0, Eigen::Index{boundary} * (Dim - 1), problem.num_control_points(),
                              Dim - 1) =
        boundary_slopes(problem, f, tangents).template cast<Scalar>();
    data.boundary_index[f] = boundary++;
  }
}

// The radius phi A / mu and the smoothing epsilon A / (mu + epsilon A) of the Z-step.
template <class Scalar, int Dim>
void set_up_proximal_maps(const LbcProblem<Dim>& problem, double penalty, Eigen::Index rows,
                          ConstraintData<Scalar, Dim>& data) {
  data.smoothing.resize(problem.mesh.num_cells());
  data.radius.setZero(rows, problem.mesh.num_cells());
  parallel_for(problem.mesh.num_cells(), [&](Index s) {
    const double scale = cell_geometry(problem.mesh, s).measure / penalty;
    const double quadratic = problem.smoothness * scale;
    data.smoothing[s] = static_cast<Scalar>(quadratic / (1 + quadratic));
    for (Index i = 0; i < problem.num_control_points(); ++i) {
      data.radius(i, s) = static_cast<Scalar>(scale * problem.phi(i, s));
    }
  });
}

}  // namespace

template <class Scalar, int Dim>
ConstraintData<Scalar, Dim> make_constraint_data(const LbcProblem<Dim>& problem, double penalty) {
  const Index n = problem.num_control_points();
  const auto rows = static_cast<Eigen::Index>(padded(static_cast<std::size_t>(n)));
  ConstraintData<Scalar, Dim> data;
  const BarycentricConstraints<Dim> constraints(problem.cage.points);
  data.basis.setZero(rows, Dim + 1);
  data.basis.topRows(n) = constraints.basis().template cast<Scalar>();
  data.target = constraints.gradient_target().template cast<Scalar>();
  set_up_facets(problem, rows, data);
  set_up_proximal_maps(problem, penalty, rows, data);
  return data;
}

FLBC_INSTANTIATE_SCALAR_FUNCTION(make_constraint_data)

}  // namespace flbc::gradient
