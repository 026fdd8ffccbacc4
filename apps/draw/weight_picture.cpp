// SPDX-License-Identifier: BSD-3-Clause
#include "draw/weight_picture.h"

#include <algorithm>

#include "draw/plane_painter.h"
#include "draw/weight_painter.h"
#include "flbc/errors.h"

namespace flbc::draw {

Image draw_weights(const Cage<2>& cage, const DomainMesh<2>& mesh, const Eigen::VectorXd& values,
                   Index control_point, const WeightPictureOptions& options) {
  validate(options);
  check_edges(cage);
  check_weight(values, mesh.num_vertices(), control_point, cage.size());
  const Box content = bounding_box(cage.points);
  const PictureLayout layout = plan_picture(content, options);
  Canvas canvas = new_canvas(layout.width, layout.height, options);
  const PixelMap map(content, layout.frame);
  const double unit = std::max(0.6, pixel_unit(options));
  paint_outline(canvas, map, mesh.points, outline_of(mesh.cells), unit);
  paint_function(canvas, map, cage, mesh, values, control_point, options, unit);
  if (options.color_bar) {
    paint_color_bar(canvas, layout.color_bar, control_point, values.minCoeff(), values.maxCoeff(),
                    options);
  }
  return canvas.resolve();
}

Image draw_all(const Cage<2>& cage, const DomainMesh<2>& mesh, const WeightMatrix& weights,
               const std::vector<Index>& control_points, const WeightPictureOptions& options) {
  validate(options);
  check_edges(cage);
  if (control_points.empty()) throw OptionError("there is no control point to draw");
  const Box content = bounding_box(cage.points);
  const int count = static_cast<int>(control_points.size());
  const auto sheet = plan_sheet(content, count, options);
  Canvas canvas = new_canvas(sheet.width, sheet.height, options);
  const auto outline = outline_of(mesh.cells);
  const double unit = std::max(0.6, 0.7 * pixel_unit(options));
  for (int k = 0; k < count; ++k) {
    const Index control_point = control_points[k];
    check_weight(control_point >= 0 && control_point < weights.rows()
                     ? Eigen::VectorXd(weights.row(control_point))
                     : Eigen::VectorXd(),
                 mesh.num_vertices(), control_point, cage.size());
    const PixelMap map(content, sheet.frames[k]);
    paint_outline(canvas, map, mesh.points, outline, unit);
    paint_function(canvas, map, cage, mesh, weights.row(control_point), control_point, options,
                   unit);
    paint_symbol(canvas, sheet.label(k), control_point, sheet.label_height);
  }
  return canvas.resolve();
}

}  // namespace flbc::draw
