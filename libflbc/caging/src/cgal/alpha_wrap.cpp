// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <limits>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include "caging/cage_steps.h"
#include "caging/cgal/to_cage.h"
#include "caging/surface_tools.h"

namespace flbc {

namespace {

namespace wraps = CGAL::Alpha_wraps_3::internal;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
#if CGAL_VERSION_NR < 1060000000
using WrapTraits = wraps::Alpha_wrap_AABB_traits<Kernel>;
template <class Oracle>
using Wrapping = wraps::Alpha_wrap_3<Oracle>;
#else
using WrapTraits = wraps::Alpha_wrap_AABB_geom_traits<Kernel>;
template <class Oracle>
using Wrapping = wraps::Alpha_wrapper_3<Oracle>;
#endif
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;

Vector<3> vector(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

Point point(const Vector<3>& p) {
  return {p.x(), p.y(), p.z()};
}

// Answers what the wrapping asks about a model. An oracle of CGAL would build a search tree of its
// own, and its distances are slower: cages took twice the time. CGAL has no public name for this
// concept.
class Oracle {
 public:
  using Geom_traits = WrapTraits;
  using Box = Enclosure<3>::Box;

  explicit Oracle(const Enclosure<3>& model) : model_(model) {}

  Geom_traits geom_traits() const { return {}; }
  CGAL::Bbox_3 bbox() const {
    return point(model_.box().min()).bbox() + point(model_.box().max()).bbox();
  }

  bool do_intersect(const Geom_traits::Ball_3& ball) const {
    const auto& sphere = ball.boundary();
    return model_.is_within(vector(sphere.center()), std::sqrt(sphere.squared_radius()));
  }

  template <class Tetrahedron>
  bool do_intersect(const Tetrahedron& cell) const {
    const Geom_traits traits;
    const auto test = traits.do_intersect_3_object();
    std::array<Box, 4> corners;
    Box around;
    for (int k = 0; k < 4; ++k) around.extend(corners[k] = Box(vector(cell.m_tet[k])));
    const auto plane = [&](int opposite) {
      Eigen::Matrix3d side;
      for (int k = 0; k < 3; ++k) side.col(k) = corners[(opposite + k + 1) % 4].min();
      return PlaneOfFacet<3>(side, around.merged(model_.box()));
    };
    const std::array planes{plane(0), plane(1), plane(2), plane(3)};
    return model_.tree().any_of(
        [&](const Box& box) {
          if (!box.intersects(around)) return false;
          for (int k = 0; k < 4; ++k) {
            if (planes[k].side_of(box) * planes[k].side_of(corners[k]) < 0) return false;
          }
          return true;
        },
        [&](Index number) {
          const auto& simplex = model_.simplices()[number];
          const Point a = point(simplex.corners.col(0)), b = point(simplex.corners.col(1));
          if (simplex.count == 1) return test(cell, a);
          if (simplex.count == 2) return test(cell, Kernel::Segment_3(a, b));
          return test(cell, Kernel::Triangle_3(a, b, point(simplex.corners.col(2))));
        });
  }

  Point closest_point(const Point& p) const { return point(model_.nearest_point(vector(p))); }
  // Asked by assertions of CGAL.
  double squared_distance(const Point& p) const {
    return CGAL::squared_distance(p, closest_point(p));
  }

  // The first point of a segment that has the offset as its distance from the model. No step is
  // longer than what remains to it, because distances change by no more than the length of the way.
  bool first_intersection(const Point& from, const Point& to, Point& found, double offset) const {
    const double precision = 1e-2 * offset;
    const Vector<3> start = vector(from), way = vector(to) - start;
    double limit = std::numeric_limits<double>::infinity();
    for (double length = 0; length <= way.norm();) {
      const Vector<3> p = start + length * way.normalized();
      const double step = model_.distance(p, limit) - offset;
      found = point(p);
      if (step <= precision) return true;
      length += step;
      limit = offset + 2 * step;
    }
    return false;
  }

 private:
  const Enclosure<3>& model_;
};

}  // namespace

Cage<3> wrap(const Enclosure<3>& model, const WrapSize& size) {
  const Oracle oracle(model);
  Surface surface;
  Wrapping<Oracle> wrapping(oracle);
  wrapping(size.alpha, size.offset, surface, CGAL::parameters::default_values());
  surface.collect_garbage();
  return to_cage(surface);
}

}  // namespace flbc
