// SPDX-License-Identifier: BSD-3-Clause
#include "caging/thickness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "base/parallel.h"
#include "cage/box_tree.h"
#include "caging/surface_tools.h"
#include "flbc/bounding_box.h"

namespace flbc {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

struct Ray {
  Vector<3> origin, direction;

  // Whether it passes through a box, or may do so.
  bool meets(const BoxTree<3>::Box& box) const {
    double begin = 0, end = kNothing;
    for (int k = 0; k < 3; ++k) {
      const double one = (box.min()(k) - origin(k)) / direction(k);
      const double other = (box.max()(k) - origin(k)) / direction(k);
      // A ray within a side of the box makes these NaN, which min and max then leave out.
      begin = std::max(begin, std::min(one, other));
      end = std::min(end, std::max(one, other));
    }
    return begin <= end;
  }

  // The distance to a triangle, by Cramer's rule. It is a bit larger, so that no ray passes between
  // two triangles by rounding.
  double distance_to(const Eigen::Matrix3d& corners) const {
    constexpr double kRounding = 1e-9;
    const Vector<3> u = corners.col(1) - corners.col(0), v = corners.col(2) - corners.col(0);
    const Vector<3> across = direction.cross(v), from = origin - corners.col(0);
    const double determinant = u.dot(across);
    const Vector<3> turned = from.cross(u);
    const double s = from.dot(across) / determinant, t = direction.dot(turned) / determinant;
    const double distance = v.dot(turned) / determinant;
    const bool is_hit = s >= -kRounding && t >= -kRounding && s + t <= 1 + kRounding;
    return is_hit && distance > 0 ? distance : kNothing;
  }
};

// The inward normal, and six directions at 30 degrees from it. Square roots are the same on all
// systems, sines are not.
std::vector<Vector<3>> directions_around(const Vector<3>& inward) {
  const double high = std::sqrt(0.75);
  const std::pair<double, double> around[] = {{1, 0},  {0.5, high},   {-0.5, high},
                                              {-1, 0}, {-0.5, -high}, {0.5, -high}};
  const Vector<3> side = inward.unitOrthogonal(), other = inward.cross(side);
  std::vector<Vector<3>> directions{inward};
  for (const auto& [along, across] : around) {
    directions.push_back(high * inward + 0.5 * (along * side + across * other));
  }
  return directions;
}

}  // namespace

std::vector<double> thickness_of(const Cage<3>& surface) {
  const auto normals = vertex_normals(surface);
  const BoxTree<3> tree(boxes_of<3, 3>(surface.points, surface.facets));
  const double size = bounding_box_diagonal<3>(surface.points);
  std::vector<double> thickness(static_cast<std::size_t>(surface.size()));
  parallel_for(surface.size(), [&](Index v) {
    std::vector<double> lengths;
    for (const auto& direction : directions_around(-normals.col(v).normalized())) {
      const Ray ray{surface.points.col(v), direction};
      double nearest = size;
      tree.any_of([&](const BoxTree<3>::Box& box) { return ray.meets(box); },
                  [&](Index f) {
                    const auto facet = surface.facets.col(f);
                    if ((facet.array() != v).all()) {
                      const Eigen::Matrix3d corners = surface.points(Eigen::all, facet);
                      nearest = std::min(nearest, ray.distance_to(corners));
                    }
                    return false;
                  });
      lengths.push_back(nearest);
    }
    // Near edges some rays are short; at the tip of a limb the middle one is long.
    std::sort(lengths.begin(), lengths.end());
    thickness[v] = lengths[lengths.size() - 2];
  });
  return thickness;
}

}  // namespace flbc
