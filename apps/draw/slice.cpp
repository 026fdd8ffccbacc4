// SPDX-License-Identifier: BSD-3-Clause
#include "draw/slice.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "flbc/errors.h"

namespace flbc::draw {
namespace {

// Below this a weight does not count for the choice of planes.
constexpr double kSupport = 0.01;

// Of the cage, that slices cover: nearer ones would hide each other in the picture.
constexpr double kLeastRange = 0.25;

struct CutPoint {
  Vector<2> position;
  double value;
};

// Where the plane meets the edges of one list of points. A point in the plane counts as above it,
// for all its edges.
class EdgeCutter {
 public:
  EdgeCutter(const PointList<3>& points, const Plane& plane) : points_(points), plane_(plane) {
    distances_ = (plane.normal.transpose() * (points.colwise() - plane.origin)).transpose();
  }

  bool above(Index v) const { return distances_[v] >= 0; }

  // How far along from a to b the plane is met. The order of the vertices must not matter, so that
  // all cells at an edge find bitwise the same point.
  CutPoint cut_edge(Index a, Index b, const Eigen::VectorXd* values) const {
    if (a > b) std::swap(a, b);
    const double t = distances_[a] / (distances_[a] - distances_[b]);
    const Vector<3> p = points_.col(a) + t * (points_.col(b) - points_.col(a));
    const double value = values != nullptr ? (*values)[a] + t * ((*values)[b] - (*values)[a]) : 0.0;
    return {plane_.to_plane(p), value};
  }

 private:
  const PointList<3>& points_;
  const Plane& plane_;
  Eigen::VectorXd distances_;
};

double doubled_area(const CutPoint& a, const CutPoint& b, const CutPoint& c) {
  const Vector<2> u = b.position - a.position;
  const Vector<2> v = c.position - a.position;
  return u.x() * v.y() - u.y() * v.x();
}

void append_triangle(const CutPoint& a, const CutPoint& b, const CutPoint& c,
                     std::vector<CutPoint>& corners) {
  if (doubled_area(a, b, c) < 0) {
    corners.insert(corners.end(), {a, c, b});
  } else {
    corners.insert(corners.end(), {a, b, c});
  }
}

// A tetrahedron gives a triangle if one vertex is alone on its side, else a quadrangle.
void cut_cell(const std::array<Index, 4>& cell, const EdgeCutter& cutter,
              const Eigen::VectorXd& values, std::vector<CutPoint>& corners) {
  std::array<Index, 4> sorted{};
  int num_above = 0;
  int num_below = 0;
  for (const Index v : cell) sorted[cutter.above(v) ? num_above++ : 3 - num_below++] = v;
  const auto meet = [&](int a, int b) { return cutter.cut_edge(sorted[a], sorted[b], &values); };
  if (num_above == 1) append_triangle(meet(0, 1), meet(0, 2), meet(0, 3), corners);
  if (num_above == 3) append_triangle(meet(3, 0), meet(3, 1), meet(3, 2), corners);
  if (num_above == 2) {
    // In this order the four edges follow each other round the cell.
    const std::array<CutPoint, 4> quadrangle{meet(0, 2), meet(0, 3), meet(1, 3), meet(1, 2)};
    append_triangle(quadrangle[0], quadrangle[1], quadrangle[2], corners);
    append_triangle(quadrangle[0], quadrangle[2], quadrangle[3], corners);
  }
}

void store(const std::vector<CutPoint>& corners, Slice& slice) {
  const auto count = static_cast<Index>(corners.size());
  slice.mesh.points.resize(2, count);
  slice.mesh.cells.resize(3, count / 3);
  slice.values.resize(count);
  for (Index k = 0; k < count; ++k) {
    slice.mesh.points.col(k) = corners[k].position;
    slice.mesh.cells(k % 3, k / 3) = k;
    slice.values[k] = corners[k].value;
  }
}

struct Interval {
  double low;
  double high;
  double length() const { return high - low; }
};

// Where the function is not as good as 0, on the axis.
Interval support_of(const DomainMesh<3>& mesh, const Eigen::VectorXd& values, int axis,
                    double at_control_point) {
  Interval support{at_control_point, at_control_point};
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    if (values[v] < kSupport) continue;
    support.low = std::min(support.low, mesh.points(axis, v));
    support.high = std::max(support.high, mesh.points(axis, v));
  }
  return support;
}

// The range to be covered by slices, on the axis.
Interval range_of_slices(const Interval& extent, Interval support) {
  const double missing = std::max(0.0, kLeastRange * extent.length() - support.length()) / 2;
  support = {support.low - missing, support.high + missing};
  const double shift =
      std::max(0.0, extent.low - support.low) - std::max(0.0, support.high - extent.high);
  return {std::max(extent.low, support.low + shift), std::min(extent.high, support.high + shift)};
}

}  // namespace

Plane plane_through(const Vector<3>& origin, const Vector<3>& normal) {
  if (!(normal.norm() > 0)) throw OptionError("the normal of a plane must not be zero");
  Plane plane;
  plane.origin = origin;
  plane.normal = normal.normalized();
  int flattest = 0;
  plane.normal.cwiseAbs().minCoeff(&flattest);
  const Vector<3> axis = Vector<3>::Unit(flattest);
  plane.u = (axis - plane.normal.dot(axis) * plane.normal).normalized();
  plane.v = plane.normal.cross(plane.u);
  return plane;
}

std::vector<Segment> section_of(const Cage<3>& surface, const Plane& plane) {
  const EdgeCutter cutter(surface.points, plane);
  std::vector<Segment> outline;
  for (const auto& facet : surface.facets.colwise()) {
    std::vector<Vector<2>> ends;
    for (int k = 0; k < 3; ++k) {
      const Index a = facet[k];
      const Index b = facet[(k + 1) % 3];
      if (cutter.above(a) != cutter.above(b)) {
        ends.push_back(cutter.cut_edge(a, b, nullptr).position);
      }
    }
    if (ends.size() == 2) outline.push_back({ends[0], ends[1]});
  }
  return outline;
}

Slice cut(const Cage<3>& cage, const DomainMesh<3>& mesh, const Eigen::VectorXd& values,
          const Plane& plane) {
  Slice slice{plane};
  const EdgeCutter cutter(mesh.points, plane);
  std::vector<CutPoint> corners;
  for (const auto& cell : mesh.cells.colwise()) {
    cut_cell({cell[0], cell[1], cell[2], cell[3]}, cutter, values, corners);
  }
  store(corners, slice);
  slice.outline = section_of(cage, plane);
  return slice;
}

std::vector<Plane> choose_planes(const Cage<3>& cage, const DomainMesh<3>& mesh,
                                 const Eigen::VectorXd& values, Index control_point, int count) {
  if (count < 1) {
    throw OptionError("the number of slices must be at least 1, not " + std::to_string(count));
  }
  const Vector<3> low = cage.points.rowwise().minCoeff();
  const Vector<3> high = cage.points.rowwise().maxCoeff();
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const double at_control_point = cage.points(axis, control_point);
  const auto support = support_of(mesh, values, axis, at_control_point);
  const auto range = range_of_slices({low[axis], high[axis]}, support);
  // A slice through a tip of the cage would miss the function beside it.
  const double beside = 0.2 * support.length();
  const double most_seen =
      std::clamp(at_control_point, support.low + beside, support.high - beside);

  const double spacing = range.length() / count;
  std::vector<Plane> planes;
  for (int k = 0; k < count; ++k) {
    // Each slice has a place of its own in the range; the one in whose place the function is seen
    // best moves there. At the very end of a cage a slice would be empty, hence the limits.
    const double begin = range.low + k * spacing;
    const bool nearest = most_seen >= begin && most_seen <= begin + spacing;
    const double position =
        nearest ? std::clamp(most_seen, begin + 0.1 * spacing, begin + 0.9 * spacing)
                : begin + 0.5 * spacing;
    Vector<3> origin = (low + high) / 2;
    origin[axis] = position;
    planes.push_back(plane_through(origin, Vector<3>::Unit(axis)));
  }
  return planes;
}

}  // namespace flbc::draw
