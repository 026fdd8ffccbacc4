// SPDX-License-Identifier: BSD-3-Clause
#include "draw/scene.h"

#include "draw/cage_wire.h"
#include "draw/weight_painter.h"

namespace flbc::draw {

void paint_slice(Canvas& canvas, const Slice& slice,
                 const std::function<Vector<2>(const Vector<2>&)>& pixel, double unit,
                 const WeightPictureOptions& options) {
  PointList<2> points(2, slice.mesh.num_vertices());
  for (Index v = 0; v < slice.mesh.num_vertices(); ++v) {
    points.col(v) = pixel(slice.mesh.points.col(v));
  }
  paint_weight(canvas, points, slice.mesh.cells, slice.values, options);
  std::vector<Segment> outline;
  for (const Segment& segment : slice.outline) {
    outline.push_back({pixel(segment.a), pixel(segment.b)});
  }
  canvas.draw_segments(outline, 2.2 * unit, kInk);
}

void paint_scene(Canvas& canvas, const Scene& scene) {
  paint_shell(canvas, scene);
  const auto slabs = cut_wire(scene);
  const int count = static_cast<int>(scene.slices.size());
  const bool ascending = scene.slices.front().plane.normal.dot(scene.view.toward) > 0;
  for (int k = 0; k <= count; ++k) {
    paint_wire(canvas, slabs[ascending ? k : count - k], scene.unit);
    if (k == count) break;
    const Slice& slice = scene.slices[ascending ? k : count - 1 - k];
    paint_slice(
        canvas, slice, [&](const Vector<2>& p) { return scene.pixel(slice.plane.to_space(p)); },
        scene.unit, scene.options);
  }
}

}  // namespace flbc::draw
