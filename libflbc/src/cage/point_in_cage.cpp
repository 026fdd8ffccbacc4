// SPDX-License-Identifier: BSD-3-Clause
#include "cage/point_in_cage.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "base/distance_to_segment.h"
#include "base/instantiate.h"
#include "base/union_find.h"

namespace flbc {
namespace {

// Whether the ray from p along the first axis crosses the segment. Half-open in the second
// coordinate, so a ray through a corner counts its two edges consistently.
bool crosses_ray(const Vector<2>& p, const Vector<2>& a, const Vector<2>& b) {
  if ((a.y() > p.y()) == (b.y() > p.y())) return false;
  const double side = (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
  return (b.y() > a.y()) == (side > 0);
}

// Adds angles and counts full turns, by products of complex numbers instead of arc tangents. The
// sum of the solid angles of a closed surface is 4 pi times the winding number, so half of each is
// added.
class Turns {
 public:
  // Half the solid angle under which a triangle appears (van Oosterom & Strackee 1983).
  // \param u, v, w  unit vectors to its corners
  void add_half_solid_angle(const Vector<3>& u, const Vector<3>& v, const Vector<3>& w) {
    add(1 + u.dot(v) + v.dot(w) + w.dot(u), u.dot(v.cross(w)));
  }

  Index count() const { return turns_; }

 private:
  // Adds the argument, in (-pi, pi], of a complex number.
  void add(double real, double imaginary) {
    const double next_real = real_ * real - imaginary_ * imaginary;
    const double next_imaginary = real_ * imaginary + imaginary_ * real;
    const double size = std::abs(next_real) + std::abs(next_imaginary);
    if (!(size > 0)) return;  // seen from the border of the triangle
    const bool is_below = next_imaginary < 0;
    if ((imaginary_ < 0) == (imaginary < 0) && (imaginary < 0) != is_below) {
      turns_ += is_below ? 1 : -1;
    }
    real_ = next_real / size;
    imaginary_ = next_imaginary / size;
  }

  double real_ = 1, imaginary_ = 0;
  Index turns_ = 0;
};

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
    std::vector<Turns> turns(static_cast<std::size_t>(num_shells_));
    const PointList<3> directions = (cage_.points.colwise() - point).colwise().normalized();
    for (Index facet = 0; facet < cage_.facets.cols(); ++facet) {
      turns[shell_of_facet_[facet]].add_half_solid_angle(directions.col(cage_.facets(0, facet)),
                                                         directions.col(cage_.facets(1, facet)),
                                                         directions.col(cage_.facets(2, facet)));
    }
    Index enclosing = 0;
    for (const Turns& shell : turns) enclosing += shell.count() != 0;
    return enclosing % 2 == 1;
  }
}

FLBC_INSTANTIATE_FUNCTION(facet_shells)
template class CageLocator<2>;
template class CageLocator<3>;

}  // namespace flbc
