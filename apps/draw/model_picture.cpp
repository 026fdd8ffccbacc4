// SPDX-License-Identifier: BSD-3-Clause
#include "draw/model_picture.h"

#include <algorithm>

#include "draw/weight_painter.h"
#include "flbc/errors.h"

namespace flbc::draw {
namespace {

void check_indices(const DrawnModel& model, const ModelPlace& place) {
  const auto num_points = place.points.cols();
  const auto num_control_points = place.control_points.cols();
  if (!place.points.allFinite() || !place.control_points.allFinite()) {
    throw InputError("a vertex of the model or a control point is not finite");
  }
  if (model.triangles.size() > 0 &&
      (model.triangles.minCoeff() < 0 || model.triangles.maxCoeff() >= num_points)) {
    throw InputError("a triangle of the model refers to a vertex that does not exist");
  }
  for (const auto& [i, j] : model.cage_edges) {
    if (std::min(i, j) < 0 || std::max(i, j) >= num_control_points) {
      throw InputError("an edge of the cage refers to a control point that does not exist");
    }
  }
}

void check(const DrawnModel& model, const std::vector<ModelPlace>& places,
           const ShownValues& shown) {
  if (places.empty()) throw InputError("there is no place of the model to draw");
  const auto& first = places.front();
  for (const auto& place : places) {
    if (place.points.cols() != first.points.cols() ||
        place.control_points.cols() != first.control_points.cols()) {
      throw InputError(
          "the model or its cage has another number of vertices at rest than in the pose");
    }
    check_indices(model, place);
  }
  if (shown.values.size() != 0 && shown.values.size() != first.points.cols()) {
    throw InputError("there are values of " + std::to_string(shown.values.size()) +
                     " vertices, but the model has " + std::to_string(first.points.cols()));
  }
  if (!shown.values.allFinite()) throw InputError("a value to be shown is not finite");
}

// All that the model and its cage cover in any of the places.
Box common_box(const std::vector<ModelPlace>& places, const ObliqueView& view) {
  PointList<2> ends(2, 0);
  for (const auto& place : places) {
    for (const auto* points : {&place.points, &place.control_points}) {
      if (points->cols() == 0) continue;
      const PointList<2> seen = view.project(*points);
      ends.conservativeResize(2, ends.cols() + 2);
      ends.rightCols(2) << seen.rowwise().minCoeff(), seen.rowwise().maxCoeff();
    }
  }
  return bounding_box(ends);
}

bool is_lengths(const ShownValues& shown) {
  return shown.values.size() > 0 && shown.control_point < 0;
}

void paint_bar(Canvas& canvas, const Box& bar, const ShownValues& shown, double largest,
               const WeightPictureOptions& options) {
  if (shown.values.size() == 0) return;
  if (is_lengths(shown)) {
    paint_length_bar(canvas, bar, largest, options);
    return;
  }
  auto without_lines = options;
  without_lines.isolines = 0;
  without_lines.support_level = 0;
  paint_color_bar(canvas, bar, shown.control_point, shown.values.minCoeff(),
                  shown.values.maxCoeff(), without_lines);
}

}  // namespace

std::string draw_model(const DrawnModel& model, const std::vector<ModelPlace>& places,
                       const ShownValues& shown, const ObliqueView& view,
                       const WeightPictureOptions& options) {
  validate(options);
  check(model, places, shown);
  const auto [in_a_row, gap] = arrange_poses(common_box(places, view).size());
  std::vector<Vector<2>> shifts;
  std::vector<Box> boxes;  // of all that is shown with a place: later ones have the first as ghost
  Box all = common_box({places.front()}, view);
  for (const auto& place : places) {
    boxes.push_back(common_box({places.front(), place}, view));
    const Box& box = boxes.back();
    if (shifts.empty()) {
      shifts.emplace_back(0, 0);
      continue;
    }
    shifts.push_back(in_a_row ? Vector<2>(all.high.x() + gap - box.low.x(), 0)
                              : Vector<2>(0, all.low.y() - gap - box.high.y()));
    all = {all.low.cwiseMin(box.low + shifts.back()), all.high.cwiseMax(box.high + shifts.back())};
  }

  auto shown_options = options;
  shown_options.color_bar = options.color_bar && shown.values.size() > 0;
  const PictureLayout layout = plan_picture(all, shown_options);
  const double largest = is_lengths(shown) ? shown.values.maxCoeff() : 1;
  const Eigen::VectorXd values =
      largest > 0 ? Eigen::VectorXd(shown.values / largest) : shown.values;
  Canvas canvas(layout.width, layout.height, options.format);
  const PixelMap map(all, layout.frame);
  const double unit = std::max(0.6, pixel_unit(options));
  const auto scene = [&](std::size_t place, std::size_t panel, const Eigen::VectorXd& colors) {
    return ModelScene{model, places[place], colors,        shown.control_point,
                      view,  map,           shifts[panel], unit};
  };
  const Eigen::VectorXd plain;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (k > 0) paint_ghost(canvas, scene(0, k, plain));
    paint_model(canvas, scene(k, k, values));
    if (places.size() == 1) break;
    const Box& box = boxes[k];
    paint_label(canvas, map(Vector<2>(Vector<2>(box.center().x(), box.high.y()) + shifts[k])),
                k == 0 ? kRestLabel : kPoseLabel, pixel_unit(options));
  }
  if (shown_options.color_bar) paint_bar(canvas, layout.color_bar, shown, largest, options);
  return canvas.encode();
}

std::string draw_model_sheet(const DrawnModel& model, const ModelPlace& place,
                             const WeightMatrix& weights, const ObliqueView& view,
                             const WeightPictureOptions& options) {
  validate(options);
  check(model, {place}, {});
  const auto count = static_cast<int>(place.control_points.cols());
  if (weights.rows() != count || weights.cols() != place.points.cols()) {
    throw InputError("the weights do not belong to this model and cage");
  }
  const Box content = common_box({place}, view);
  const auto sheet = plan_sheet(content, count, options);
  Canvas canvas(sheet.width, sheet.height, options.format);
  for (int i = 0; i < count; ++i) {
    const Eigen::VectorXd values = weights.row(i);
    check_weight(values, static_cast<Index>(place.points.cols()), i, count);
    paint_model(canvas, {model, place, values, i, view, PixelMap(content, sheet.frames[i]),
                         Vector<2>::Zero(), std::max(0.4, 0.5 * pixel_unit(options))});
    paint_symbol(canvas, sheet.label(i), i, sheet.label_height);
  }
  return canvas.encode();
}

std::string draw_panels(const DrawnModel& model, const std::vector<ModelPanel>& panels,
                        Index control_point, const ObliqueView& view,
                        const WeightPictureOptions& options) {
  constexpr double kLines = 0.7;  // width, relative to that of labels
  validate(options);
  std::vector<ModelPlace> places;
  for (const auto& panel : panels) {
    places.push_back(panel.place);
    check(model, {places.front(), panel.place}, {panel.values, control_point});
  }
  if (places.empty()) throw InputError("there is nothing to draw");
  const Box content = common_box(places, view);
  const auto sheet = plan_sheet(content, static_cast<int>(panels.size()), options);
  Canvas canvas(sheet.width, sheet.height, options.format);
  const double unit = std::max(0.6, 0.7 * pixel_unit(options));
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const auto& [label, place, values] = panels[k];
    const auto& frame = sheet.frames[k];
    paint_model(canvas, {model, place, values, values.size() > 0 ? control_point : -1, view,
                         PixelMap(content, frame), Vector<2>::Zero(), kLines * unit});
    paint_label(canvas, {frame.center().x(), frame.low.y()}, label, unit);
  }
  return canvas.encode();
}

}  // namespace flbc::draw
