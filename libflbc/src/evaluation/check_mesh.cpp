// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/check_mesh.h"

#include <algorithm>

#include "base/parallel.h"
#include "evaluation/extremes.h"
#include "flbc/harmonic.h"
#include "flbc/quality.h"
#include "mesh/vertex_cells.h"

namespace flbc {
namespace {

constexpr double kExtremumMargin = 1e-6;

// Extrema found in a part of the mesh; parts are added up in the order of vertices.
template <int Dim>
struct Extrema {
  Eigen::Matrix<Index, Eigen::Dynamic, 1> minima, maxima;  // n
  Extreme<Dim> deepest, highest;

  explicit Extrema(Index n) : minima(n), maxima(n) {
    minima.setZero();
    maxima.setZero();
  }
  Extrema& operator+=(const Extrema& next) {
    minima += next.minima;
    maxima += next.maxima;
    keep_larger(deepest, next.deepest);
    keep_larger(highest, next.highest);
    return *this;
  }
};

// Each neighbour once, because cells share them.
template <int Dim>
void collect_neighbours(const DomainMesh<Dim>& mesh, const VertexCells& around, Index vertex,
                        std::vector<Index>& neighbours) {
  neighbours.clear();
  for (const Index s : around.cells_of(vertex)) {
    for (const Index v : mesh.cells.col(s)) {
      if (v != vertex) neighbours.push_back(v);
    }
  }
  std::sort(neighbours.begin(), neighbours.end());
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
}

template <int Dim>
Extrema<Dim> find_extrema(const DomainMesh<Dim>& mesh, const std::vector<Index>& interior,
                          const WeightMatrix& weights) {
  const VertexCells around(mesh);
  const auto n = static_cast<Index>(weights.rows());
  const auto search = [&](Index begin, Index end) {
    Extrema<Dim> found(n);
    std::vector<Index> neighbours;
    Eigen::ArrayXd lowest, highest;
    for (Index k = begin; k < end; ++k) {
      const Index v = interior[k];
      const Vector<Dim> place = mesh.points.col(v);
      collect_neighbours(mesh, around, v, neighbours);
      lowest = highest = weights.col(neighbours.front());
      for (const Index w : neighbours) {
        lowest = lowest.min(weights.col(w).array());
        highest = highest.max(weights.col(w).array());
      }
      for (Index i = 0; i < n; ++i) {
        const double depth = lowest[i] - weights(i, v);
        const double height = weights(i, v) - highest[i];
        if (depth > kExtremumMargin) {
          ++found.minima[i];
          keep_larger(found.deepest, {depth, v, i, place});
        }
        if (height > kExtremumMargin) {
          ++found.maxima[i];
          keep_larger(found.highest, {height, v, i, place});
        }
      }
    }
    return found;
  };
  return parallel_sum(static_cast<Index>(interior.size()), Extrema<Dim>(n), search);
}

}  // namespace

template <int Dim>
MeshCheck<Dim> check_on_mesh(const LbcProblem<Dim>& problem, const DomainMesh<Dim>& domain,
                             const WeightMatrix& weights, double mean_influences) {
  const auto interior = problem.boundary.interior_vertices();
  MeshCheck<Dim> check;
  check.interior_vertices = static_cast<Index>(interior.size());
  const auto extrema = find_extrema(domain, interior, weights);
  check.local_minima.assign(extrema.minima.begin(), extrema.minima.end());
  check.local_maxima.assign(extrema.maxima.begin(), extrema.maxima.end());
  check.deepest_minimum = extrema.deepest;
  check.highest_maximum = extrema.highest;
  check.total_variation = total_variation(domain, weights);

  const auto harmonic = harmonic_coordinates(problem);
  check.harmonic_total_variation = total_variation(domain, harmonic);
  check.harmonic_mean_influences =
      static_cast<double>((harmonic.array().abs() > kInfluenceThreshold).count()) /
      static_cast<double>(domain.num_vertices());
  check.influence_ratio = mean_influences / check.harmonic_mean_influences;
  return check;
}

template MeshCheck<2> check_on_mesh(const LbcProblem<2>&, const DomainMesh<2>&, const WeightMatrix&,
                                    double);
template MeshCheck<3> check_on_mesh(const LbcProblem<3>&, const DomainMesh<3>&, const WeightMatrix&,
                                    double);

}  // namespace flbc
