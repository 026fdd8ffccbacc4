// SPDX-License-Identifier: BSD-3-Clause
#include "draw/slice_panels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "draw/weight_painter.h"
#include "flbc/bounding_box.h"

namespace flbc::draw {
namespace {

// The slice's own axes, turned by multiples of 90 degrees and mirrored such that the panel looks as
// the slice would if the eye moved before it.
struct PanelAxes {
  Vector<2> right;
  Vector<2> up;

  Vector<2> turn(const Vector<2>& p) const { return {right.dot(p), up.dot(p)}; }
};

PanelAxes panel_axes(const Plane& plane, const ObliqueView& view) {
  const double along_u = plane.u.dot(view.right);
  const double along_v = plane.v.dot(view.right);
  const Vector<2> right = std::abs(along_u) >= std::abs(along_v)
                              ? Vector<2>(std::copysign(1.0, along_u), 0)
                              : Vector<2>(0, std::copysign(1.0, along_v));
  const Vector<2> left_turn(-right.y(), right.x());
  return {right, plane.normal.dot(view.toward) >= 0 ? left_turn : Vector<2>(-left_turn)};
}

// The slices that are not empty, from the left to the right or from the top to the bottom.
std::vector<const Slice*> in_reading_order(const Scene& scene, bool row) {
  std::vector<const Slice*> slices;
  for (const Slice& slice : scene.slices) {
    if (slice.mesh.num_cells() > 0) slices.push_back(&slice);
  }
  const Vector<3>& normal = scene.slices.front().plane.normal;
  const bool reverse = row ? normal.dot(scene.view.right) < 0 : normal.dot(scene.view.up) > 0;
  if (reverse) std::reverse(slices.begin(), slices.end());
  return slices;
}

Box box_of(const Slice& slice, const PanelAxes& axes) {
  PointList<2> turned(2, slice.mesh.num_vertices());
  for (Index v = 0; v < slice.mesh.num_vertices(); ++v) {
    turned.col(v) = axes.turn(slice.mesh.points.col(v));
  }
  return {turned.rowwise().minCoeff(), turned.rowwise().maxCoeff()};
}

}  // namespace

void paint_panels(Canvas& canvas, const Scene& scene, const Box& strip, Index control_point) {
  const bool row = strip.size().x() > strip.size().y();
  const auto slices = in_reading_order(scene, row);
  if (slices.empty()) return;
  const PanelAxes axes = panel_axes(scene.slices.front().plane, scene.view);
  Vector<2> largest(0, 0);
  for (const Slice* slice : slices) largest = largest.cwiseMax(box_of(*slice, axes).size());

  const auto count = static_cast<double>(slices.size());
  const double gap = std::min(30 * scene.unit, strip.size().maxCoeff() / (4 * count));
  const Vector<2> direction = row ? Vector<2>(1, 0) : Vector<2>(0, 1);
  const double length = (direction.dot(strip.size()) - (count - 1) * gap) / count;
  const Vector<2> panel_size =
      row ? Vector<2>(length, strip.size().y()) : Vector<2>(strip.size().x(), length);
  const Vector<3> highlighted = scene.cage.points.col(control_point);
  const double near = 0.01 * bounding_box_diagonal<3>(scene.cage.points);

  for (std::size_t k = 0; k < slices.size(); ++k) {
    const Slice& slice = *slices[k];
    const Vector<2> corner = strip.low + static_cast<double>(k) * (length + gap) * direction;
    const Vector<2> center = box_of(slice, axes).center();
    const PixelMap map({center - largest / 2, center + largest / 2}, {corner, corner + panel_size});
    const auto pixel = [&](const Vector<2>& p) { return map(axes.turn(p)); };
    paint_slice(canvas, slice, pixel, scene.unit, scene.options);
    if (std::abs(slice.plane.distance(highlighted)) < near) {
      paint_dot(canvas, pixel(slice.plane.to_plane(highlighted)), 7 * scene.unit, kHighlight);
    }
  }
}

}  // namespace flbc::draw
