// SPDX-License-Identifier: BSD-3-Clause
#include "draw/weight_painter.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "draw/isolines.h"
#include "front/colormap.h"

namespace flbc::draw {
namespace {

constexpr Color kSupportLine{0.36F, 0.39F, 0.44F};

void fill_cells(Canvas& canvas, const PointList<2>& points, const CellList<2>& cells,
                const Eigen::VectorXd& values) {
  Raster raster = canvas.raster_for(points);
  for (const auto& v : cells.colwise()) {
    const Vector<3> corners(values[v[0]], values[v[1]], values[v[2]]);
    raster.fill({points.col(v[0]), points.col(v[1]), points.col(v[2])}, Vector<3>::Zero(),
                [&](double b0, double b1, double b2) {
                  return weight_color(corners.dot(Vector<3>(b0, b1, b2)));
                });
  }
  canvas.draw_raster(raster);
}

void fill_box(Canvas& canvas, const Box& box, double value_at_bottom, double value_at_top) {
  PointList<2> corners(2, 4);
  corners << box.low.x(), box.high.x(), box.high.x(), box.low.x(),  //
      box.low.y(), box.low.y(), box.high.y(), box.high.y();
  CellList<2> halves(3, 2);
  halves << 0, 0, 1, 2, 2, 3;
  fill_cells(canvas, corners, halves,
             Eigen::Vector4d(value_at_top, value_at_top, value_at_bottom, value_at_bottom));
}

void draw_outline(Canvas& canvas, const Box& box, double width) {
  const Vector<2> low_right(box.high.x(), box.low.y());
  const Vector<2> high_left(box.low.x(), box.high.y());
  canvas.draw_segments(
      {{box.low, low_right}, {low_right, box.high}, {box.high, high_left}, {high_left, box.low}},
      width, kInk);
}

// A patch of the colors that show defects, with its label.
void draw_defect_patch(Canvas& canvas, const Box& box, double slight, double severe,
                       const char* label, double unit) {
  fill_box(canvas, box, std::min(slight, severe), std::max(slight, severe));
  draw_outline(canvas, box, 1.2 * unit);
  canvas.draw_text({box.high.x() + 11 * unit, box.center().y() + 8 * unit}, label, 16 * unit, kInk);
}

// The colors from 0 to 1, upright, with isolines and numbers at 0, the middle and the end.
void paint_scale(Canvas& canvas, const Box& box, int isolines, double unit) {
  const char* const labels[] = {"0", "0.5", "1"};
  fill_box(canvas, box, 0, 1);
  const auto row_of = [&](double weight) { return box.high.y() - weight * box.size().y(); };
  std::vector<Segment> lines;
  for (const double level : isoline_levels(isolines)) {
    lines.push_back({{box.low.x(), row_of(level)}, {box.high.x(), row_of(level)}});
  }
  canvas.draw_segments(lines, 1.5 * std::max(0.6, unit), kInk, 0.75F);
  draw_outline(canvas, box, 1.2 * unit);
  for (int k = 0; k < 3; ++k) {
    const double y = row_of(k / 2.0);
    canvas.draw_segments({{{box.high.x(), y}, {box.high.x() + 6 * unit, y}}}, 1.2 * unit, kInk);
    canvas.draw_text({box.high.x() + 13 * unit, y + 9 * unit}, labels[k], 18 * unit, kInk);
  }
}

}  // namespace

void paint_weight(Canvas& canvas, const PointList<2>& points, const CellList<2>& cells,
                  const Eigen::VectorXd& values, const WeightPictureOptions& options) {
  // Lines below a pixel's width would fade in small pictures.
  const double unit = std::max(0.6, pixel_unit(options));
  fill_cells(canvas, points, cells, values);
  if (options.support_level > 0) {
    canvas.draw_segments(trace_isolines(points, cells, values, {options.support_level}), 1.3 * unit,
                         kSupportLine);
  }
  canvas.draw_segments(trace_isolines(points, cells, values, isoline_levels(options.isolines)),
                       1.5 * unit, kInk, 0.75F);
}

void paint_dots(Canvas& canvas, const std::vector<Vector<2>>& centers, double radius, Color color) {
  canvas.fill_discs(centers, 1.3 * radius, kWhite);
  canvas.fill_discs(centers, radius, color);
}

void paint_label(Canvas& canvas, const Vector<2>& top, const std::string& label, double unit) {
  const double height = 18 * unit;
  canvas.draw_text({top.x() - text_width(label, height) / 2, top.y() - height}, label, height,
                   kInk);
}

void paint_color_bar(Canvas& canvas, const Box& box, Index control_point, double least,
                     double greatest, const WeightPictureOptions& options) {
  const double unit = pixel_unit(options);
  const double patch = box.size().x();
  const double gap = 10 * unit;
  double top = box.low.y();
  if (greatest > 1 + kWeightTolerance) {
    top -= gap + patch;
    draw_defect_patch(canvas, {{box.low.x(), top}, {box.high.x(), top + patch}},
                      1 + 2 * kWeightTolerance, 1.1, ">1", unit);
  }
  if (least < -kWeightTolerance) {
    const double below = box.high.y() + gap;
    draw_defect_patch(canvas, {{box.low.x(), below}, {box.high.x(), below + patch}},
                      -2 * kWeightTolerance, -0.1, "<0", unit);
  }
  paint_label(canvas, {box.center().x(), top - 8 * unit}, "w" + std::to_string(control_point),
              unit);
  if (options.support_level > 0) {
    const double y = box.high.y() + 3 * gap + patch;
    canvas.draw_segments({{{box.low.x(), y}, {box.high.x(), y}}}, 1.3 * std::max(0.6, unit),
                         kSupportLine);
    std::ostringstream level;
    level << options.support_level;
    canvas.draw_text({box.high.x() + 11 * unit, y + 8 * unit}, level.str(), 16 * unit, kInk);
  }
  paint_scale(canvas, box, options.isolines, unit);
}

}  // namespace flbc::draw
