// SPDX-License-Identifier: BSD-3-Clause
#include "draw/weight_picture.h"

#include <algorithm>
#include <cmath>

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
  Canvas canvas(layout.width, layout.height, kWhite);
  paint_function(canvas, PixelMap(content, layout.frame), cage, mesh, values, control_point,
                 options, std::max(0.6, pixel_unit(options)));
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

  // Tiles are as wide as the content demands, their number per row makes the sheet about 4:3.
  const double aspect = std::clamp(content.size().y() / content.size().x(), 0.2, 5.0);
  const int columns =
      std::clamp(static_cast<int>(std::lround(std::sqrt(4.0 / 3 * aspect * count))), 1, count);
  const int rows = (count + columns - 1) / columns;
  const double unit = pixel_unit(options);
  const double margin = 26 * unit;
  const double label = 44 * unit;
  const double tile_width = (options.width - margin) / columns - margin;
  const double tile_height = aspect * tile_width;
  const double row_height = label + tile_height + margin;

  Canvas canvas(options.width, static_cast<int>(std::lround(rows * row_height + margin / 2)),
                kWhite);
  for (int k = 0; k < count; ++k) {
    const Index control_point = control_points[k];
    check_weight(control_point >= 0 && control_point < weights.rows()
                     ? Eigen::VectorXd(weights.row(control_point))
                     : Eigen::VectorXd(),
                 mesh.num_vertices(), control_point, cage.size());
    const Vector<2> corner(margin + (k % columns) * (tile_width + margin),
                           label + (k / columns) * row_height);
    const Box frame{corner, corner + Vector<2>(tile_width, tile_height)};
    paint_function(canvas, PixelMap(content, frame), cage, mesh, weights.row(control_point),
                   control_point, options, std::max(0.6, 0.7 * unit));
    paint_symbol(canvas, {frame.center().x(), corner.y() - 18 * unit}, control_point, 18 * unit);
  }
  return canvas.resolve();
}

}  // namespace flbc::draw
