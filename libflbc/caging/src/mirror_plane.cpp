// SPDX-License-Identifier: BSD-3-Clause
#include "caging/mirror_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "base/instantiate.h"
#include "caging/surface_tools.h"

namespace flbc {

namespace {

// Facets on one side of the plane or on both, with a new point where an edge crosses it.
template <int Dim>
class Cut {
 public:
  Cut(const Cage<Dim>& surface, const MirrorPlane& plane)
      : surface_(surface), plane_(plane), points_(surface.points) {}

  Cage<Dim> half() {
    cut_facets();
    return compact<Dim>(points_, facets_);
  }

  Cage<Dim> both() {
    cut_facets();
    keeps_larger_ = false;
    cut_facets();
    FacetList<Dim> facets(Dim, facets_.size());
    for (std::size_t f = 0; f < facets_.size(); ++f) facets.col(static_cast<Index>(f)) = facets_[f];
    return {points_, facets};
  }

 private:
  void cut_facets() {
    for (Index f = 0; f < surface_.facets.cols(); ++f) cut_facet(surface_.facets.col(f));
  }

  bool is_kept(Index vertex) const {
    return (points_(plane_.axis, vertex) > plane_.position) == keeps_larger_;
  }

  // The crossing of the edge between two vertices on different sides.
  Index crossing(Index a, Index b) {
    const auto [entry, is_new] =
        crossings_.emplace(std::minmax(a, b), static_cast<Index>(points_.cols()));
    if (is_new) {
      const Vector<Dim> p = points_.col(std::min(a, b)), q = points_.col(std::max(a, b));
      const double t = (plane_.position - p(plane_.axis)) / (q(plane_.axis) - p(plane_.axis));
      points_.conservativeResize(Dim, points_.cols() + 1);
      points_.rightCols(1) = p + t * (q - p);
      points_(plane_.axis, points_.cols() - 1) = plane_.position;
    }
    return entry->second;
  }

  // The corners that are kept and the crossings, in order: a triangle or quadrilateral in 3D.
  void cut_facet(const FacetCorners<Dim>& corners) {
    std::vector<Index> polygon;
    for (int k = 0; k < (Dim == 2 ? 1 : 3); ++k) {
      const Index a = corners(k), b = corners((k + 1) % Dim);
      if (is_kept(a)) polygon.push_back(a);
      if (is_kept(a) != is_kept(b)) polygon.push_back(crossing(a, b));
      if (Dim == 2 && is_kept(b)) polygon.push_back(b);
    }
    if constexpr (Dim == 2) {
      if (polygon.size() == 2) facets_.push_back({polygon[0], polygon[1]});
    } else {
      for (std::size_t k = 2; k < polygon.size(); ++k) {
        facets_.push_back({polygon[0], polygon[k - 1], polygon[k]});
      }
    }
  }

  const Cage<Dim>& surface_;
  const MirrorPlane plane_;
  bool keeps_larger_ = true;
  PointList<Dim> points_;
  std::vector<FacetCorners<Dim>> facets_;
  std::map<std::pair<Index, Index>, Index> crossings_;
};

template <int Dim>
Cage<Dim> joined(const Cage<Dim>& one, const Cage<Dim>& other) {
  Cage<Dim> both{PointList<Dim>(Dim, one.size() + other.size()),
                 FacetList<Dim>(Dim, one.facets.cols() + other.facets.cols())};
  both.points << one.points, other.points;
  both.facets << one.facets, (other.facets.array() + one.size()).matrix();
  return both;
}

}  // namespace

template <int Dim>
Cage<Dim> with_mirror_image(const Cage<Dim>& shape, const MirrorPlane& plane) {
  Cage<Dim> image = shape;
  image.points.row(plane.axis) = 2 * plane.position - shape.points.row(plane.axis).array();
  image.facets.row(0).swap(image.facets.row(1));
  return joined(shape, image);
}

template <int Dim>
Cage<Dim> cut_half(const Cage<Dim>& surface, const MirrorPlane& plane, double nearest) {
  Cage<Dim> moved = surface;
  for (Index v = 0; v < moved.size(); ++v) {
    double& x = moved.points(plane.axis, v);
    if (std::abs(x - plane.position) < nearest) x = plane.position + nearest;
  }
  return Cut<Dim>(moved, plane).half();
}

template <int Dim>
Cage<Dim> cut_along(const Cage<Dim>& surface, const MirrorPlane& plane) {
  return Cut<Dim>(surface, plane).both();
}

// Facets are cut where the stretched part ends, because they would have to bend there. What is
// between both ends is added at each of them, because it may touch neither.
template <int Dim>
Cage<Dim> Parting::part(const Cage<Dim>& shape) const {
  Cage<Dim> parted = shape;
  const double low = plane.position - nearest, high = plane.position + nearest;
  for (const double end : {low, high}) parted = cut_along<Dim>(parted, {plane.axis, end});
  std::vector<FacetCorners<Dim>> between;
  for (const FacetCorners<Dim> corners : parted.facets.colwise()) {
    const auto places = parted.points.row(plane.axis)(corners).array();
    if ((places >= low && places <= high).all()) between.push_back(corners);
  }
  auto ends = compact<Dim>(parted.points, between);
  ends.points.row(plane.axis).setConstant(high + width);
  ends = with_mirror_image(ends, plane);
  for (double& x : parted.points.row(plane.axis)) {
    const double distance = x - plane.position;
    const double stretch = std::min(1.0, std::abs(distance) / nearest);
    x += std::copysign(stretch * width, distance);
  }
  return joined(parted, ends);
}

template <int Dim>
Cage<Dim> Parting::joined_half(const Cage<Dim>& surface) const {
  const MirrorPlane end{plane.axis, plane.position + nearest + width};
  const auto normals = vertex_normals(surface);
  Cage<Dim> lifted = surface;
  for (Index v = 0; v < surface.size(); ++v) {
    double& x = lifted.points(plane.axis, v);
    const bool faces_plane = normals(plane.axis, v) < -0.5 * normals.col(v).norm();
    if (faces_plane && x > end.position - overlap) x = std::max(x, end.position + nearest);
  }
  Cage<Dim> half = cut_half(lifted, end, nearest);
  for (double& x : half.points.row(plane.axis)) {
    x = x == end.position ? plane.position : x - (end.position - plane.position);
  }
  return half;
}

template <int Dim>
Cage<Dim> join_halves(const Cage<Dim>& half, const MirrorPlane& plane) {
  const Cage<Dim> both = with_mirror_image(half, plane);
  std::vector<FacetCorners<Dim>> facets;
  for (Index f = 0; f < both.facets.cols(); ++f) {
    FacetCorners<Dim> corners = both.facets.col(f);
    for (int k = 0; k < Dim; ++k) {
      const Index original = corners(k) % half.size();
      if (plane.contains(half.points.col(original))) corners(k) = original;
    }
    facets.push_back(corners);
  }
  return compact<Dim>(both.points, facets);
}

template Cage<2> Parting::part(const Cage<2>&) const;
template Cage<3> Parting::part(const Cage<3>&) const;
template Cage<2> Parting::joined_half(const Cage<2>&) const;
template Cage<3> Parting::joined_half(const Cage<3>&) const;
FLBC_INSTANTIATE_FUNCTION(with_mirror_image)
FLBC_INSTANTIATE_FUNCTION(cut_half)
FLBC_INSTANTIATE_FUNCTION(cut_along)
FLBC_INSTANTIATE_FUNCTION(join_halves)

}  // namespace flbc
