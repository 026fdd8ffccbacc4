// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/active_set/active_lists.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "coordinates/poisson_weights.h"
#include "polytope/nearest_point_in_hull.h"
#include "solver/plan/constants.h"

namespace flbc::active_set {
namespace {

using Flags = Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>;

// Per vertex, the control points that are relevant at it or at a neighbor. n x V
//! \param matters_at  of a vertex, n flags
template <int Dim, class MattersAt>
Flags flags_of(const DomainMesh<Dim>& mesh, Index num_control_points, const MattersAt& matters_at) {
  Flags matters(num_control_points, mesh.num_vertices());
  parallel_for(mesh.num_vertices(), [&](Index v) { matters.col(v) = matters_at(v); });
  Flags near = matters;
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    Eigen::Array<bool, Eigen::Dynamic, 1> any = matters.col(mesh.cells(0, s)).array();
    for (int k = 1; k <= Dim; ++k) any = any || matters.col(mesh.cells(k, s)).array();
    for (const Index v : mesh.cells.col(s)) {
      near.col(v).array() = near.col(v).array() || any;
    }
  }
  return near;
}

// Vertices next to a facet need the control points of the weights on the facet.
template <int Dim>
void add_boundary(const LbcProblem<Dim>& problem, Flags& flags) {
  const auto& boundary = problem.boundary;
  const auto add = [&](Index b, Index v) {
    for (int k = 0; k < Dim; ++k) {
      if (boundary.values(k, b) != 0) flags(boundary.control_points(k, b), v) = true;
    }
  };
  for (Index b = 0; b < static_cast<Index>(boundary.vertices.size()); ++b) {
    flags.col(boundary.vertices[b]).setConstant(false);
    add(b, boundary.vertices[b]);
  }
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    for (const Index v : problem.mesh.cells.col(s)) {
      const Index b = boundary.boundary_index[v];
      if (b < 0) continue;
      for (const Index u : problem.mesh.cells.col(s)) {
        if (boundary.is_interior(u)) add(b, u);
      }
    }
  }
}

// Whether a vertex lies in the convex hull of its control points, so feasible weights exist.
template <int Dim>
bool is_feasible(const LbcProblem<Dim>& problem, Index v, const Flags& flags) {
  const double tolerance = 1e-9 * problem.cage.points.cwiseAbs().maxCoeff();
  PointList<Dim> points(Dim, flags.col(v).count());
  Index count = 0;
  for (Index i = 0; i < flags.rows(); ++i) {
    if (flags(i, v)) points.col(count++) = problem.cage.points.col(i);
  }
  if (count == 0) return false;
  const Vector<Dim> point = problem.mesh.points.col(v);
  return nearest_point_in_hull<Dim>(points, point).distance <= tolerance;
}

ActiveLists lists_from(const Flags& is_in) {
  return items_by_vertex<ControlPoint>(static_cast<Index>(is_in.cols()), [&](const auto& visit) {
    for (Index v = 0; v < static_cast<Index>(is_in.cols()); ++v) {
      for (Index i = 0; i < static_cast<Index>(is_in.rows()); ++i) {
        if (is_in(i, v)) visit(v, static_cast<ControlPoint>(i));
      }
    }
  });
}

// Adds the control points that every vertex needs. \param weights  feasible ones of an interior
// vertex
template <int Dim>
ActiveLists completed(const LbcProblem<Dim>& problem, const VectorsAt<1>& weights, Flags flags) {
  add_boundary(problem, flags);
  parallel_for_chunks(problem.mesh.num_vertices(), 64, [&](Index v) {
    if (!problem.boundary.is_interior(v) || is_feasible(problem, v, flags)) return;
    flags.col(v).array() = flags.col(v).array() || weights(v).array() > 0;
  });
  return lists_from(flags);
}

// Calls action(place, u) for the entries in the list of an interior vertex whose control points are
// missing at another interior vertex u of the same cell, in order.
template <int Dim, class Action>
void for_missing(const LbcProblem<Dim>& problem, const VertexCells& around,
                 const ActiveLists& active, Index v, const Action& action) {
  std::vector<Index> neighbours;
  for (const Index s : around.cells_of(v)) {
    for (const Index u : problem.mesh.cells.col(s)) {
      if (u != v && problem.boundary.is_interior(u)) neighbours.push_back(u);
    }
  }
  std::sort(neighbours.begin(), neighbours.end());
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
  const auto list = active.of(v);
  for (const Index u : neighbours) {
    const auto other = active.of(u);
    const ControlPoint* theirs = other.first;
    for (const ControlPoint* item = list.first; item != list.last; ++item) {
      while (theirs != other.last && *theirs < *item) ++theirs;
      if (theirs == other.last || *theirs != *item)
        action(static_cast<Index>(item - list.first), u);
    }
  }
}

}  // namespace

double threshold_for(double tolerance) {
  return std::clamp(plan::kActiveErrors * std::sqrt(tolerance), plan::kActiveLeast,
                    plan::kActiveMost);
}

template <int Dim>
ActiveLists active_from(const LbcProblem<Dim>& problem, const Transfer<Dim>& coarse,
                        double threshold) {
  constexpr double kNotInterpolated = 1e-12;
  const auto& mesh = coarse.coarse_mesh();
  const auto& weights = coarse.coarse_weights();
  const Flags near = flags_of(mesh, problem.num_control_points(),
                              [&](Index v) { return (weights.at(v).array() > threshold).eval(); });
  Flags flags = Flags::Constant(problem.num_control_points(), problem.mesh.num_vertices(), false);
  parallel_for(problem.mesh.num_vertices(), [&](Index v) {
    const auto& place = coarse.place_of(v);
    for (int k = 0; k <= Dim; ++k) {
      if (place.coordinates[k] <= kNotInterpolated) continue;
      flags.col(v).array() = flags.col(v).array() || near.col(mesh.cells(k, place.cell)).array();
    }
  });
  return completed(problem, coarse.start().weights, std::move(flags));
}

template <int Dim>
ActiveLists active_of(const LbcProblem<Dim>& problem, const VectorsAt<1>& weights,
                      double threshold) {
  const auto of_vertex = with_known_values(problem, weights);
  auto flags = flags_of(problem.mesh, problem.num_control_points(),
                        [&](Index v) { return (of_vertex(v).array() > threshold).eval(); });
  return completed(problem, weights, std::move(flags));
}

template <int Dim>
VectorsAt<Dim> where_weights_are(const LbcProblem<Dim>& problem, const Start<Dim>& start,
                                 double threshold) {
  return [&problem, lists = active_of(problem, start.weights, threshold),
          flux_density = start.flux_density](Index s) {
    const Vectors<Dim> all = flux_density(s);
    Vectors<Dim> near = Vectors<Dim>::Zero(all.rows(), Dim);
    for (const Index v : problem.mesh.cells.col(s)) {
      for (const ControlPoint i : lists.of(v)) near.row(i) = all.row(i);
    }
    return near;
  };
}

template <int Dim>
ColdStart<Dim> cold_start(const LbcProblem<Dim>& problem, LinearSolver linear_solver) {
  const DirichletProblem<Dim> laplace(problem.mesh, problem.boundary, linear_solver);
  // Accurate enough for a start.
  const auto harmonic = std::make_shared<const Eigen::MatrixXf>(
      harmonic_coordinates(problem, laplace).template cast<float>());
  ColdStart<Dim> cold;
  cold.start.weights = [harmonic](Index v) -> Eigen::VectorXd {
    return harmonic->col(v).template cast<double>();
  };
  cold.start.flux_density = [n = problem.num_control_points()](Index) -> Vectors<Dim> {
    return Vectors<Dim>::Zero(n, Dim);
  };
  cold.active = active_of(problem, cold.start.weights, plan::kLeastHarmonic);
  return cold;
}

template <int Dim>
ActiveLists grown(const LbcProblem<Dim>& problem, const ActiveLists& active, double threshold,
                  const WeightInList& weight) {
  Flags flags = Flags::Constant(problem.num_control_points(), problem.mesh.num_vertices(), false);
  const VertexCells around(problem.mesh);
  for (Index v = 0; v < problem.mesh.num_vertices(); ++v) {
    const auto list = active.of(v);
    for (const ControlPoint i : list) flags(i, v) = true;
    if (!problem.boundary.is_interior(v)) continue;
    for_missing(problem, around, active, v, [&](Index place, Index u) {
      if (weight(v, place) > threshold) flags(list.first[place], u) = true;
    });
  }
  return lists_from(flags);
}

template <int Dim>
double squared_at_ends(const LbcProblem<Dim>& problem, const ActiveLists& active,
                       const WeightInList& weight) {
  const VertexCells around(problem.mesh);
  const auto interior = problem.boundary.interior_vertices();
  return parallel_sum(static_cast<Index>(interior.size()), 0.0, [&](Index begin, Index end) {
    double sum = 0;
    std::vector<bool> is_end;
    for (Index k = begin; k < end; ++k) {
      const Index v = interior[k];
      is_end.assign(active.start[v + 1] - active.start[v], false);
      for_missing(problem, around, active, v, [&](Index place, Index) { is_end[place] = true; });
      for (Index place = 0; place < static_cast<Index>(is_end.size()); ++place) {
        const double w = is_end[place] ? weight(v, place) : 0;
        sum += w * w;
      }
    }
    return sum;
  });
}

template <int Dim>
double density(const LbcProblem<Dim>& problem, const ActiveLists& active) {
  const auto interior = problem.boundary.interior_vertices();
  double pairs = 0;
  for (const Index v : interior) pairs += active.start[v + 1] - active.start[v];
  const auto all = static_cast<double>(interior.size()) * problem.num_control_points();
  return interior.empty() ? 1 : pairs / all;
}

FLBC_INSTANTIATE_FUNCTION(active_from)
FLBC_INSTANTIATE_FUNCTION(active_of)
FLBC_INSTANTIATE_FUNCTION(where_weights_are)
FLBC_INSTANTIATE_FUNCTION(cold_start)
FLBC_INSTANTIATE_FUNCTION(grown)
FLBC_INSTANTIATE_FUNCTION(squared_at_ends)
FLBC_INSTANTIATE_FUNCTION(density)

}  // namespace flbc::active_set
