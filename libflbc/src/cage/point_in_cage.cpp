// SPDX-License-Identifier: BSD-3-Clause
#include "cage/point_in_cage.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "base/instantiate.h"
#include "base/union_find.h"

namespace flbc {
namespace {

constexpr double kFullSolidAngle = 12.566370614359172;  // 4 pi

// Whether the ray from p along the first axis crosses the segment. Half-open in the second
// coordinate, so a ray through a corner counts its two edges consistently.
bool crosses_ray(const Vector<2>& p, const Vector<2>& a, const Vector<2>& b) {
  if ((a.y() > p.y()) == (b.y() > p.y())) return false;
  const double side = (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
  return (b.y() > a.y()) == (side > 0);
}

// The signed solid angle under which the triangle appears from p, in (-2 pi, 2 pi]
// (van Oosterom & Strackee 1983).
double solid_angle(const Vector<3>& p, const Vector<3>& a, const Vector<3>& b, const Vector<3>& c) {
  const Vector<3> u = a - p, v = b - p, w = c - p;
  const double lu = u.norm(), lv = v.norm(), lw = w.norm();
  const double determinant = u.dot(v.cross(w));
  const double cosine = lu * lv * lw + u.dot(v) * lw + v.dot(w) * lu + w.dot(u) * lv;
  return 2 * std::atan2(determinant, cosine);
}

template <int Dim>
double distance_to_segment(const Vector<Dim>& p, const Vector<Dim>& a, const Vector<Dim>& b) {
  const Vector<Dim> along = b - a;
  const double squared = along.squaredNorm();
  const double t = squared > 0 ? std::clamp((p - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

}  // namespace

template <>
double distance_to_facet<2>(const Vector<2>& point, const Eigen::Matrix2d& corners) {
  return distance_to_segment<2>(point, corners.col(0), corners.col(1));
}

template <>
double distance_to_facet<3>(const Vector<3>& point, const Eigen::Matrix3d& corners) {
  const Vector<3> normal =
      (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).normalized();
  bool is_above = normal.squaredNorm() > 0;
  double distance = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Vector<3> from = corners.col(k);
    const Vector<3> to = corners.col((k + 1) % 3);
    is_above = is_above && normal.cross(to - from).dot(point - from) >= 0;
    distance = std::min(distance, distance_to_segment<3>(point, from, to));
  }
  return is_above ? std::abs(normal.dot(point - corners.col(0))) : distance;
}

template <int Dim>
std::vector<Index> facet_shells(const Cage<Dim>& cage) {
  check_elements(cage.points, cage.facets, kCageNames);
  UnionFind components(cage.size());
  for (Index facet = 0; facet < cage.facets.cols(); ++facet) {
    for (int k = 1; k < Dim; ++k) components.unite(cage.facets(0, facet), cage.facets(k, facet));
  }
  std::vector<Index> number_of_root(static_cast<std::size_t>(cage.size()), -1);
  std::vector<Index> shells(static_cast<std::size_t>(cage.facets.cols()));
  Index num_shells = 0;
  for (Index facet = 0; facet < cage.facets.cols(); ++facet) {
    Index& number = number_of_root[components.find(cage.facets(0, facet))];
    if (number < 0) number = num_shells++;
    shells[facet] = number;
  }
  return shells;
}

template <int Dim>
CageLocator<Dim>::CageLocator(const Cage<Dim>& cage, double tolerance)
    : cage_(cage), shell_of_facet_(facet_shells(cage)), tolerance_(tolerance) {
  for (Index shell : shell_of_facet_) num_shells_ = std::max(num_shells_, shell + 1);
}

template <int Dim>
Containment CageLocator<Dim>::locate(const Vector<Dim>& point) const {
  if (is_on_cage(point)) return Containment::kOnCage;
  return is_enclosed(point) ? Containment::kInside : Containment::kOutside;
}

template <int Dim>
bool CageLocator<Dim>::is_outside(const Vector<Dim>& point) const {
  return !is_enclosed(point) && !is_on_cage(point);
}

template <int Dim>
bool CageLocator<Dim>::is_on_cage(const Vector<Dim>& point) const {
  for (Index facet = 0; facet < cage_.facets.cols(); ++facet) {
    const Eigen::Matrix<double, Dim, Dim> corners =
        cage_.points(Eigen::all, cage_.facets.col(facet));
    if (distance_to_facet<Dim>(point, corners) <= tolerance_) return true;
  }
  return false;
}

template <int Dim>
bool CageLocator<Dim>::is_enclosed(const Vector<Dim>& point) const {
  if constexpr (Dim == 2) {
    // Counts crossings instead of winding numbers, because loops need not be oriented consistently.
    bool is_odd = false;
    for (Index edge = 0; edge < cage_.facets.cols(); ++edge) {
      is_odd ^= crosses_ray(point, cage_.points.col(cage_.facets(0, edge)),
                            cage_.points.col(cage_.facets(1, edge)));
    }
    return is_odd;
  } else {
    // Uses winding numbers per shell, because a ray could graze an edge, and shells may have either
    // orientation.
    std::vector<double> angles(static_cast<std::size_t>(num_shells_), 0.0);
    for (Index facet = 0; facet < cage_.facets.cols(); ++facet) {
      angles[shell_of_facet_[facet]] += solid_angle(point, cage_.points.col(cage_.facets(0, facet)),
                                                    cage_.points.col(cage_.facets(1, facet)),
                                                    cage_.points.col(cage_.facets(2, facet)));
    }
    Index enclosing = 0;
    for (double angle : angles) enclosing += std::abs(angle) > kFullSolidAngle / 2;
    return enclosing % 2 == 1;
  }
}

FLBC_INSTANTIATE_FUNCTION(facet_shells)
template class CageLocator<2>;
template class CageLocator<3>;

}  // namespace flbc
