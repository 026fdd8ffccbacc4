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

// Facets on one side of the plane, with a new point where an edge crosses it.
template <int Dim>
class Cut {
 public:
  Cut(const Cage<Dim>& surface, const MirrorPlane& plane)
      : surface_(surface), plane_(plane), points_(surface.points) {}

  Cage<Dim> half() {
    for (Index f = 0; f < surface_.facets.cols(); ++f) cut_facet(surface_.facets.col(f));
    return compact<Dim>(points_, facets_);
  }

 private:
  bool is_kept(Index vertex) const { return points_(plane_.axis, vertex) > plane_.position; }

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
  const MirrorPlane& plane_;
  PointList<Dim> points_;
  std::vector<FacetCorners<Dim>> facets_;
  std::map<std::pair<Index, Index>, Index> crossings_;
};

template <int Dim>
void reverse(Eigen::Ref<FacetList<Dim>> facets) {
  facets.row(0).swap(facets.row(1));
}

}  // namespace

template <int Dim>
Cage<Dim> with_mirror_image(const Cage<Dim>& shape, const MirrorPlane& plane) {
  const Index n = shape.size(), m = static_cast<Index>(shape.facets.cols());
  Cage<Dim> both{PointList<Dim>(Dim, 2 * n), FacetList<Dim>(Dim, 2 * m)};
  both.points << shape.points, shape.points;
  both.points.row(plane.axis).tail(n) = 2 * plane.position - shape.points.row(plane.axis).array();
  both.facets << shape.facets, (shape.facets.array() + n).matrix();
  reverse<Dim>(both.facets.rightCols(m));
  return both;
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

FLBC_INSTANTIATE_FUNCTION(with_mirror_image)
FLBC_INSTANTIATE_FUNCTION(cut_half)
FLBC_INSTANTIATE_FUNCTION(join_halves)

}  // namespace flbc
