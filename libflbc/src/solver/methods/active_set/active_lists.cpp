// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/active_set/active_lists.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "coordinates/poisson_weights.h"
#include "polytope/nearest_point_in_hull.h"
#include "solver/plan/constants.h"

namespace flbc::active_set {
namespace {

// Per control point; a matrix of all vertices would be among the largest arrays of a solve.
using Flags = Eigen::Array<bool, Eigen::Dynamic, 1>;

// The lists of all vertices. \param set  set(v, flags) raises the flags of a vertex
template <class Set>
ActiveLists lists_of(Index num_vertices, Index num_control_points, const Set& set) {
  std::vector<std::vector<ControlPoint>> lists(num_vertices);
  const auto make_flags = [&] { return Flags(num_control_points); };
  parallel_for_chunks(num_vertices, 64, make_flags, [&](Index v, Flags& flags) {
    flags.setConstant(false);
    set(v, flags);
    lists[v].reserve(flags.count());
    for (Index i = 0; i < num_control_points; ++i) {
      if (flags[i]) lists[v].push_back(static_cast<ControlPoint>(i));
    }
  });
  ActiveLists all{{0}, {}};
  for (const auto& list : lists) {
    all.items.insert(all.items.end(), list.begin(), list.end());
    all.start.push_back(all.items.size());
  }
  return all;
}

void add(const ActiveLists::Range& list, Flags& flags) {
  for (const ControlPoint i : list) flags[i] = true;
}

// Adds the lists at a vertex and its neighbors.
template <int Dim>
void add_around(const DomainMesh<Dim>& mesh, const VertexCells& around, const ActiveLists& lists,
                Index v, Flags& flags) {
  for (const Index s : around.cells_of(v)) {
    for (const Index u : mesh.cells.col(s)) add(lists.of(u), flags);
  }
}

// Per vertex, the control points that are relevant at it or at a neighbor.
//! \param matters_at  of a vertex, n flags
template <int Dim, class MattersAt>
ActiveLists near_lists(const DomainMesh<Dim>& mesh, Index n, const MattersAt& matters_at) {
  const auto matters =
      lists_of(mesh.num_vertices(), n, [&](Index v, Flags& flags) { flags = matters_at(v); });
  const VertexCells around(mesh);
  return lists_of(mesh.num_vertices(), n,
                  [&](Index v, Flags& flags) { add_around(mesh, around, matters, v, flags); });
}

// Whether a vertex lies in the convex hull of its control points, so feasible weights exist.
template <int Dim>
bool is_feasible(const LbcProblem<Dim>& problem, Index v, const Flags& flags) {
  const double tolerance = 1e-9 * problem.cage.points.cwiseAbs().maxCoeff();
  PointList<Dim> points(Dim, flags.count());
  Index count = 0;
  for (Index i = 0; i < flags.size(); ++i) {
    if (flags[i]) points.col(count++) = problem.cage.points.col(i);
  }
  if (count == 0) return false;
  const Vector<Dim> point = problem.mesh.points.col(v);
  return nearest_point_in_hull<Dim>(points, point).distance <= tolerance;
}

void apply_masks(const PointMasks& masks, Index v, Flags& flags) {
  if (!masks.at(v)) return;
  for (const Index i : masks.forbidden(v)) flags[i] = false;
}

// Adds the few allowed control points nearest to whose hull a masked vertex lies.
template <int Dim>
void add_carriers(const LbcProblem<Dim>& problem, Index v, Flags& flags) {
  const auto allowed = problem.masks.allowed(v);
  const auto nearest = nearest_point_in_hull<Dim>(problem.cage.points(Eigen::all, allowed),
                                                  problem.mesh.points.col(v));
  for (int k = 0; k < nearest.size; ++k) flags[allowed[nearest.support[k]]] = true;
}

// Adds the control points that every vertex needs: next to a facet those of the weights on the
// facet. \param weights  feasible ones of an interior vertex \param set  as in lists_of()
template <int Dim, class Set>
ActiveLists completed(const LbcProblem<Dim>& problem, const VectorsAt<1>& weights, const Set& set) {
  const auto& mesh = problem.mesh;
  const auto& boundary = problem.boundary;
  const auto add_known = [&](Index v, Flags& flags) {
    const Index b = boundary.boundary_index[v];
    for (int k = 0; k < Dim; ++k) {
      if (boundary.values(k, b) != 0) flags[boundary.control_points(k, b)] = true;
    }
  };
  const VertexCells around(mesh);
  return lists_of(mesh.num_vertices(), problem.num_control_points(), [&](Index v, Flags& flags) {
    if (!boundary.is_interior(v)) return add_known(v, flags);
    set(v, flags);
    for (const Index s : around.cells_of(v)) {
      for (const Index u : mesh.cells.col(s)) {
        if (!boundary.is_interior(u)) add_known(u, flags);
      }
    }
    apply_masks(problem.masks, v, flags);
    if (is_feasible(problem, v, flags)) return;
    flags = flags || weights(v).array() > 0;
    apply_masks(problem.masks, v, flags);
    if (problem.masks.at(v) && !is_feasible(problem, v, flags)) add_carriers(problem, v, flags);
  });
}

}  // namespace

double threshold_for(double tolerance) {
  return std::min(plan::kActiveErrors * std::sqrt(tolerance), plan::kActiveMost);
}

template <int Dim>
ActiveLists active_from(const LbcProblem<Dim>& problem, const Prolongation<Dim>& coarse,
                        double threshold) {
  const auto& weights = coarse.weights();
  const auto near = near_lists(coarse.mesh(), problem.num_control_points(),
                               [&](Index v) { return (weights.at(v).array() > threshold).eval(); });
  return completed(problem, coarse.start().weights, [&](Index v, Flags& flags) {
    for (const Index end : coarse.ends_of(v)) add(near.of(end), flags);
  });
}

template <int Dim>
ActiveLists active_of(const LbcProblem<Dim>& problem, const VectorsAt<1>& weights,
                      double threshold) {
  const auto of_vertex = with_known_values(problem, weights);
  const auto near = near_lists(problem.mesh, problem.num_control_points(),
                               [&](Index v) { return (of_vertex(v).array() > threshold).eval(); });
  return completed(problem, weights, [&](Index v, Flags& flags) { add(near.of(v), flags); });
}

template <int Dim>
ActiveLists joined(const LbcProblem<Dim>& problem, const ActiveLists& a, const ActiveLists& b) {
  return lists_of(problem.mesh.num_vertices(), problem.num_control_points(),
                  [&](Index v, Flags& flags) {
                    add(a.of(v), flags);
                    add(b.of(v), flags);
                  });
}

template <int Dim>
ActiveLists all_allowed(const LbcProblem<Dim>& problem) {
  return completed(
      problem, [&](Index) { return Eigen::VectorXd::Zero(problem.num_control_points()).eval(); },
      [&](Index, Flags& flags) { flags.setConstant(true); });
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
HarmonicStart<Dim> harmonic_start(const LbcProblem<Dim>& problem, LinearSolver linear_solver) {
  const DirichletProblem<Dim> laplace(problem.mesh, problem.boundary, linear_solver);
  // Accurate enough for a start.
  const auto harmonic = std::make_shared<const Eigen::MatrixXf>(
      harmonic_coordinates(problem, laplace).template cast<float>());
  HarmonicStart<Dim> cold;
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
  const auto& mesh = problem.mesh;
  const Index n = problem.num_control_points();
  const auto reaching = lists_of(mesh.num_vertices(), n, [&](Index v, Flags& flags) {
    if (!problem.boundary.is_interior(v)) return;
    const auto list = active.of(v);
    for (const ControlPoint* i = list.first; i != list.last; ++i) {
      flags[*i] = weight(v, static_cast<Index>(i - list.first)) > threshold;
    }
  });
  const VertexCells around(mesh);
  return lists_of(mesh.num_vertices(), n, [&](Index v, Flags& flags) {
    add(active.of(v), flags);
    if (problem.boundary.is_interior(v)) {
      add_around(mesh, around, reaching, v, flags);
      apply_masks(problem.masks, v, flags);
    }
  });
}

template <int Dim>
double squared_at_ends(const LbcProblem<Dim>& problem, const ActiveLists& active,
                       const WeightInList& weight) {
  const VertexCells around(problem.mesh);
  const auto interior = problem.boundary.interior_vertices();
  return parallel_sum(static_cast<Index>(interior.size()), 0.0, [&](Index begin, Index end) {
    double sum = 0;
    std::vector<Index> neighbours;
    for (Index k = begin; k < end; ++k) {
      neighbours.clear();
      for (const Index s : around.cells_of(interior[k])) {
        for (const Index u : problem.mesh.cells.col(s)) {
          if (problem.boundary.is_interior(u)) neighbours.push_back(u);
        }
      }
      std::sort(neighbours.begin(), neighbours.end());
      neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
      const auto list = active.of(interior[k]);
      for (const ControlPoint* i = list.first; i != list.last; ++i) {
        const bool is_end = std::any_of(neighbours.begin(), neighbours.end(), [&](Index u) {
          return !std::binary_search(active.of(u).first, active.of(u).last, *i) &&
                 !problem.masks.forbids(u, *i);
        });
        if (!is_end) continue;
        const double w = weight(interior[k], static_cast<Index>(i - list.first));
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
  for (const Index v : interior) {
    pairs += static_cast<double>(active.start[v + 1] - active.start[v]);
  }
  const auto all = static_cast<double>(interior.size()) * problem.num_control_points();
  return interior.empty() ? 1 : pairs / all;
}

FLBC_INSTANTIATE_FUNCTION(active_from)
FLBC_INSTANTIATE_FUNCTION(active_of)
FLBC_INSTANTIATE_FUNCTION(joined)
FLBC_INSTANTIATE_FUNCTION(all_allowed)
FLBC_INSTANTIATE_FUNCTION(where_weights_are)
FLBC_INSTANTIATE_FUNCTION(harmonic_start)
FLBC_INSTANTIATE_FUNCTION(grown)
FLBC_INSTANTIATE_FUNCTION(squared_at_ends)
FLBC_INSTANTIATE_FUNCTION(density)

}  // namespace flbc::active_set
