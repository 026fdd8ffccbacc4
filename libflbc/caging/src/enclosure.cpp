// SPDX-License-Identifier: BSD-3-Clause
#include "caging/enclosure.h"

#include <algorithm>
#include <cmath>

#include "base/first_equals.h"
#include "base/union_find.h"
#include "caging/surface_tools.h"

namespace flbc {

namespace {

template <int Dim>
using Box = Eigen::AlignedBox<double, Dim>;

template <int Dim>
Box<Dim> box_of(const Simplex<Dim>& simplex) {
  return {simplex.corners.rowwise().minCoeff(), simplex.corners.rowwise().maxCoeff()};
}

template <int Dim>
std::vector<Box<Dim>> boxes_of(const std::vector<Simplex<Dim>>& simplices) {
  std::vector<Box<Dim>> boxes;
  boxes.reserve(simplices.size());
  for (const auto& simplex : simplices) boxes.push_back(box_of(simplex));
  return boxes;
}

template <int Dim>
std::vector<Simplex<Dim>> collect_simplices(const PointList<Dim>& points,
                                            const FacetList<Dim>& facets) {
  std::vector<Simplex<Dim>> simplices;
  std::vector<bool> is_used(static_cast<std::size_t>(points.cols()), false);
  for (Index f = 0; f < facets.cols(); ++f) {
    Eigen::Matrix<double, Dim, Dim> corners;
    for (int k = 0; k < Dim; ++k) {
      corners.col(k) = points.col(facets(k, f));
      is_used[facets(k, f)] = true;
    }
    simplices.push_back(simplex_of<Dim>(corners));
  }
  for (Index v = 0; v < points.cols(); ++v) {
    if (is_used[v]) continue;
    simplices.push_back(simplex_of<Dim>(points.col(v).replicate(1, Dim)));
  }
  return simplices;
}

// Points at the same position are connected, even if they have different indices in the soup.
template <int Dim>
PointList<Dim> collect_representatives(const PointList<Dim>& points, const FacetList<Dim>& facets) {
  UnionFind parts(static_cast<Index>(points.cols()));
  const auto first = first_equals<Dim>(points);
  for (Index v = 0; v < points.cols(); ++v) parts.unite(v, first[v]);
  for (Index f = 0; f < facets.cols(); ++f) {
    for (int k = 1; k < Dim; ++k) parts.unite(facets(0, f), facets(k, f));
  }
  std::vector<Index> roots;
  for (Index v = 0; v < points.cols(); ++v) {
    if (parts.find(v) == v) roots.push_back(v);
  }
  PointList<Dim> representatives(Dim, roots.size());
  for (std::size_t k = 0; k < roots.size(); ++k) representatives.col(k) = points.col(roots[k]);
  return representatives;
}

template <int Dim>
Vector<Dim> nearest_on(const Simplex<Dim>& simplex, const Vector<Dim>& p) {
  if (simplex.count == 3) {
    const Vector<Dim> a = simplex.corners.col(0);
    Eigen::Matrix<double, Dim, 2> sides;
    sides << simplex.corners.col(1) - a, simplex.corners.col(2) - a;
    const Eigen::Matrix2d metric = sides.transpose() * sides;
    const double determinant = metric.determinant();
    const Eigen::Vector2d right = sides.transpose() * (p - a);
    const double s = metric(1, 1) * right(0) - metric(0, 1) * right(1);
    const double t = metric(0, 0) * right(1) - metric(1, 0) * right(0);
    if (determinant > 0 && s >= 0 && t >= 0 && s + t <= determinant) {
      return a + sides * Eigen::Vector2d(s, t) / determinant;
    }
  }
  Vector<Dim> nearest = simplex.corners.col(0);
  for (int k = 0; k < simplex.count; ++k) {
    for (int l = 0; l < k; ++l) {
      const Vector<Dim> a = simplex.corners.col(k), along = simplex.corners.col(l) - a;
      const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
      const Vector<Dim> candidate = a + t * along;
      if ((p - candidate).squaredNorm() < (p - nearest).squaredNorm()) nearest = candidate;
    }
  }
  return nearest;
}

template <int Dim>
double distance_from(const Simplex<Dim>& simplex, const Vector<Dim>& p) {
  return (p - nearest_on(simplex, p)).norm();
}

// Barycentric coordinates of the centers of equal pieces of a facet.
template <int Dim>
std::vector<Vector<Dim>> spread_coordinates() {
  constexpr int kPieces = 5;
  std::vector<Vector<Dim>> all;
  for (int i = 0; i < kPieces; ++i) {
    if constexpr (Dim == 2) {
      const double t = (i + 0.5) / kPieces;
      all.push_back({t, 1 - t});
    } else {
      for (int j = 0; i + j < kPieces; ++j) {
        const double s = (i + 1.0 / 3) / kPieces, t = (j + 1.0 / 3) / kPieces;
        all.push_back({s, t, 1 - s - t});
      }
    }
  }
  return all;
}

}  // namespace

template <int Dim>
Vector<Dim> ray_direction(int attempt, int axis) {
  Vector<Dim> d;
  for (int k = 0; k < Dim; ++k) {
    const double turn = std::fmod(0.754877666 * (attempt + 1) + 0.569840291 * (k + 1), 1.0);
    d(k) = 2 * turn - 1;
  }
  if (axis >= 0) d(axis) = 1 + std::abs(d(axis));
  return d.normalized();
}

template <int Dim>
bool has_odd_crossings(const Vector<Dim>& point, const std::vector<Simplex<Dim>>& facets,
                       int directions_axis) {
  constexpr int kAttempts = 32;
  Box<Dim> around(point);
  for (const auto& facet : facets) around.extend(box_of(facet));
  const double length = 2 * around.diagonal().norm();
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const Vector<Dim> end = point + length * ray_direction<Dim>(attempt, directions_axis);
    bool is_odd = false, is_clear = true;
    for (const auto& facet : facets) {
      const Passage how = passage<Dim>(point, end, facet);
      is_clear = is_clear && how != Passage::kUnclear;
      if (how == Passage::kThrough) is_odd = !is_odd;
    }
    if (is_clear) return is_odd;
  }
  return false;
}

template <int Dim>
Enclosure<Dim>::Enclosure(const PointList<Dim>& points, const FacetList<Dim>& facets)
    : simplices_(collect_simplices<Dim>(points, facets)),
      tree_(boxes_of(simplices_)),
      representatives_(collect_representatives<Dim>(points, facets)),
      box_(points.rowwise().minCoeff(), points.rowwise().maxCoeff()) {
}

template <int Dim>
bool Enclosure<Dim>::meets(const Simplex<Dim>& facet) const {
  const Box box = box_of(facet);
  const PlaneOfFacet<Dim> plane(facet.corners, box.merged(box_));
  return tree_.any_of(
      [&](const Box& any) { return any.intersects(box) && plane.side_of(any) == 0; },
      [&](Index number) { return intersect(simplices_[number], facet); });
}

template <int Dim>
bool Enclosure<Dim>::is_strictly_inside(const Cage<Dim>& cage) const {
  std::vector<Simplex<Dim>> facets(static_cast<std::size_t>(cage.facets.cols()));
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    for (int k = 0; k < Dim; ++k) facets[f].corners.col(k) = cage.points.col(cage.facets(k, f));
    if (meets(facets[f])) return false;
  }
  for (Index part = 0; part < representatives_.cols(); ++part) {
    if (!has_odd_crossings<Dim>(representatives_.col(part), facets)) return false;
  }
  return true;
}

template <int Dim>
Index Enclosure<Dim>::nearest(const Vector<Dim>& point, double limit) const {
  return tree_.nearest(
      point, [&](Index number) { return distance_from<Dim>(simplices_[number], point); }, limit);
}

template <int Dim>
Vector<Dim> Enclosure<Dim>::nearest_point(const Vector<Dim>& point) const {
  return nearest_on(simplices_[nearest(point, kFar)], point);
}

template <int Dim>
double Enclosure<Dim>::distance(const Vector<Dim>& point, double limit) const {
  const Index number = nearest(point, limit);
  return number < 0 ? limit : std::min(limit, distance_from<Dim>(simplices_[number], point));
}

template <int Dim>
bool Enclosure<Dim>::is_within(const Vector<Dim>& point, double distance) const {
  const double squared = distance * distance;
  return tree_.any_of(
      [&](const Box& box) { return box.squaredExteriorDistance(point) <= squared; },
      [&](Index number) { return distance_from<Dim>(simplices_[number], point) <= distance; });
}

template <int Dim>
Distances distances(const Cage<Dim>& cage, const Enclosure<Dim>& model) {
  const auto coordinates = spread_coordinates<Dim>();
  Distances result;
  double sum = 0, total = 0;
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    Eigen::Matrix<double, Dim, Dim> corners;
    for (int k = 0; k < Dim; ++k) corners.col(k) = cage.points.col(cage.facets(k, f));
    const double part = facet_normal<Dim>(corners).norm() / static_cast<double>(coordinates.size());
    for (const auto& weights : coordinates) {
      const double distance = model.distance(corners * weights);
      result.largest = std::max(result.largest, distance);
      sum += part * distance;
      total += part;
    }
  }
  for (Index v = 0; v < cage.size(); ++v) {
    result.largest = std::max(result.largest, model.distance(Vector<Dim>(cage.points.col(v))));
  }
  result.mean = sum / total;
  return result;
}

#define FLBC_INSTANTIATE(Dim)                                            \
  template Distances distances(const Cage<Dim>&, const Enclosure<Dim>&); \
  template class Enclosure<Dim>;                                         \
  template Vector<Dim> ray_direction(int, int);                          \
  template bool has_odd_crossings(const Vector<Dim>&, const std::vector<Simplex<Dim>>&, int);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
