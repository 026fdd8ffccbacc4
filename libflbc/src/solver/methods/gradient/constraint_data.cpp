// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/gradient/constraint_data.h"

#include <Eigen/LU>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "mesh/cell_geometry.h"
#include "problem/barycentric_constraints.h"
#include "solver/methods/gradient/gradient_kernel.h"

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
void set_up_facets(const LbcProblem<Dim>& problem, std::size_t stride,
                   ConstraintData<Scalar, Dim>& data) {
  constexpr std::size_t kTangents = Dim - 1;
  const auto& topology = problem.topology;
  const auto num_boundary = static_cast<std::size_t>((topology.sides.row(1).array() < 0).count());
  data.tangents.resize(topology.num_facets() * kTangents * Dim);
  data.boundary_index.assign(topology.num_facets(), -1);
  data.boundary_slope = AlignedArray<Scalar>(num_boundary * kTangents * stride);
  Index boundary = 0;
  for (Index f = 0; f < topology.num_facets(); ++f) {
    const auto tangents = tangent_basis(problem, f);
    Eigen::Map<Eigen::Matrix<Scalar, Dim, Dim - 1>>(data.tangents.data() + f * kTangents * Dim) =
        tangents.template cast<Scalar>();
    if (!topology.is_boundary(f)) continue;
    const auto slopes = boundary_slopes(problem, f, tangents);
    for (std::size_t t = 0; t < kTangents; ++t) {
      Scalar* row = data.boundary_slope.data() + (boundary * kTangents + t) * stride;
      for (Index i = 0; i < slopes.rows(); ++i) row[i] = static_cast<Scalar>(slopes(i, t));
    }
    data.boundary_index[f] = boundary++;
  }
}

template <class Scalar, int Dim>
void set_up_interpolation(const LbcProblem<Dim>& problem, std::size_t stride,
                          ConstraintData<Scalar, Dim>& data) {
  const Index n = problem.num_control_points();
  const BarycentricConstraints<Dim> constraints(problem.cage.points);
  data.basis = AlignedArray<Scalar>((Dim + 1) * stride);
  data.target = AlignedArray<Scalar>(2 * kLanes);
  const Eigen::Matrix<double, Dim + 1, Dim> target = constraints.gradient_target();
  for (int k = 0; k <= Dim; ++k) {
    for (Index i = 0; i < n; ++i) {
      data.basis[k * stride + i] = static_cast<Scalar>(constraints.basis()(i, k));
    }
    for (int d = 0; d < Dim; ++d)
      data.target[d * (Dim + 1) + k] = static_cast<Scalar>(target(k, d));
  }
}

// The radius phi A / mu and the smoothing epsilon A / (mu + epsilon A) of the Z-step.
template <class Scalar, int Dim>
void set_up_proximal_maps(const LbcProblem<Dim>& problem, double penalty, std::size_t stride,
                          ConstraintData<Scalar, Dim>& data) {
  const Index n = problem.num_control_points();
  data.smoothing.resize(problem.mesh.num_cells());
  data.radius = AlignedArray<Scalar>(static_cast<std::size_t>(problem.mesh.num_cells()) * stride);
  parallel_for(problem.mesh.num_cells(), [&](Index s) {
    const double scale = cell_geometry(problem.mesh, s).measure / penalty;
    const double quadratic = problem.smoothness * scale;
    data.smoothing[s] = static_cast<Scalar>(quadratic / (1 + quadratic));
    for (Index i = 0; i < n; ++i) {
      data.radius[s * stride + i] = static_cast<Scalar>(scale * problem.phi(i, s));
    }
  });
}

}  // namespace

template <class Scalar, int Dim>
ConstraintData<Scalar, Dim> make_constraint_data(const LbcProblem<Dim>& problem, double penalty,
                                                 std::size_t stride) {
  ConstraintData<Scalar, Dim> data;
  set_up_facets(problem, stride, data);
  set_up_interpolation(problem, stride, data);
  set_up_proximal_maps(problem, penalty, stride, data);
  return data;
}

FLBC_INSTANTIATE_SCALAR_FUNCTION(make_constraint_data)

}  // namespace flbc::gradient
