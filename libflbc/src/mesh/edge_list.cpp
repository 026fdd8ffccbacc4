// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/domain_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include "base/instantiate.h"
#include "base/messages.h"
#include "flbc/errors.h"

namespace flbc {
namespace {

// Edges shorter than this fraction of the mean length get the weight of that length. Otherwise
// nearly coincident points would dominate.
constexpr double kShortest = 1e-3;

// Sums the contributions of cells to their edges.
template <int Dim>
class ShareCollector {
 public:
  explicit ShareCollector(const PointList<Dim>& points) : points_(points) {}

  void check(Index vertex, const char* kind, std::size_t number) const {
    if (vertex >= 0 && vertex < points_.cols()) return;
    throw InputError(std::string(kind) + " " + std::to_string(number) + " has vertex " +
                     std::to_string(vertex) + ", but there are " + std::to_string(points_.cols()) +
                     " points");
  }

  void add(Index a, Index b, double share) {
    if (a != b) shares_.push_back({std::min(a, b), std::max(a, b), share});
  }

  EdgeList edges() {
    // Stable, so that the sums do not depend on the sorting algorithm.
    std::stable_sort(shares_.begin(), shares_.end(), [](const Share& s, const Share& t) {
      return s.a != t.a ? s.a < t.a : s.b < t.b;
    });
    EdgeList list;
    for (std::size_t k = 0; k < shares_.size(); ++k) {
      const auto& [a, b, share] = shares_[k];
      if (k == 0 || a != shares_[k - 1].a || b != shares_[k - 1].b) {
        list.ends.push_back({a, b});
        list.weights.push_back(0);
      }
      list.weights.back() += share;
    }
    divide_by_squared_lengths(list);
    return list;
  }

 private:
  struct Share {
    Index a, b;
    double share;
  };

  void divide_by_squared_lengths(EdgeList& list) const {
    Eigen::VectorXd lengths(list.ends.size());
    for (Eigen::Index e = 0; e < lengths.size(); ++e) {
      const auto [a, b] = list.ends[e];
      lengths[e] = (points_.col(a) - points_.col(b)).norm();
    }
    const double mean = lengths.size() > 0 ? lengths.mean() : 0;
    double largest = 0;
    for (Eigen::Index e = 0; e < lengths.size(); ++e) {
      const double length = std::max(lengths[e], kShortest * mean);
      list.weights[e] = mean > 0 ? list.weights[e] / (length * length) : 1;
      largest = std::max(largest, list.weights[e]);
    }
    // Cells without area must not leave edges without weight.
    if (!(largest > 0)) largest = 1;
    for (double& weight : list.weights) weight = std::max(weight, 1e-9 * largest);
  }

  const PointList<Dim>& points_;
  std::vector<Share> shares_;
};

template <int Dim>
double fan_area(const PointList<Dim>& points, const std::vector<Index>& polygon) {
  double area = 0;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    Vector<3> u = Vector<3>::Zero(), v = Vector<3>::Zero();
    u.template head<Dim>() = points.col(polygon[k - 1]) - points.col(polygon[0]);
    v.template head<Dim>() = points.col(polygon[k]) - points.col(polygon[0]);
    area += u.cross(v).norm() / 2;
  }
  return area;
}

}  // namespace

void validate(const EdgeList& edges, Eigen::Index num_points) {
  if (!edges.weights.empty() && edges.weights.size() != edges.ends.size()) {
    throw InputError("there are " + std::to_string(edges.ends.size()) + " edges, but weights of " +
                     std::to_string(edges.weights.size()));
  }
  for (std::size_t e = 0; e < edges.ends.size(); ++e) {
    for (const Index point : edges.ends[e]) {
      if (point >= 0 && point < num_points) continue;
      throw InputError("edge " + std::to_string(e) + " ends at point " + std::to_string(point) +
                       ", but there are " + std::to_string(num_points) + " points");
    }
    if (edges.weights.empty() || (edges.weights[e] > 0 && std::isfinite(edges.weights[e])))
      continue;
    throw InputError("the weight of edge " + std::to_string(e) + " is " +
                     format_number(edges.weights[e]) + ", but must be positive");
  }
}

template <int Dim>
EdgeList edges_of_cells(const DomainMesh<Dim>& mesh) {
  constexpr int kEdges = Dim * (Dim + 1) / 2;
  ShareCollector<Dim> collector(mesh.points);
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    const auto cell = mesh.cells.col(s);
    for (const Index v : cell) collector.check(v, "cell", static_cast<std::size_t>(s));
    const double share = Dim * std::abs(signed_measure(mesh, s)) / kEdges;
    for (int k = 0; k <= Dim; ++k) {
      for (int l = 0; l < k; ++l) collector.add(cell[l], cell[k], share);
    }
  }
  return collector.edges();
}

template <int Dim>
EdgeList edges_of_polygons(const PointList<Dim>& points,
                           const std::vector<std::vector<Index>>& polygons,
                           const std::vector<std::vector<Index>>& polylines) {
  ShareCollector<Dim> collector(points);
  for (std::size_t f = 0; f < polygons.size(); ++f) {
    const auto& polygon = polygons[f];
    for (const Index v : polygon) collector.check(v, "polygon", f);
    const double share = 2 * fan_area(points, polygon) / static_cast<double>(polygon.size());
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      collector.add(polygon[k], polygon[(k + 1) % polygon.size()], share);
    }
  }
  for (std::size_t f = 0; f < polylines.size(); ++f) {
    const auto& polyline = polylines[f];
    for (const Index v : polyline) collector.check(v, "polyline", f);
    for (std::size_t k = 1; k < polyline.size(); ++k) {
      collector.add(polyline[k - 1], polyline[k],
                    (points.col(polyline[k]) - points.col(polyline[k - 1])).norm());
    }
  }
  return collector.edges();
}

FLBC_INSTANTIATE_FUNCTION(edges_of_cells)
FLBC_INSTANTIATE_FUNCTION(edges_of_polygons)

}  // namespace flbc
