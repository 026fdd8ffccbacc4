// SPDX-License-Identifier: BSD-3-Clause
#include "draw/model_picture.h"

#include "draw/weight_painter.h"

namespace flbc::draw {
namespace {

// All that the model and its cage cover in any of the panels.
Box common_box(const std::vector<ModelPanel>& panels, const ObliqueView& view) {
  PointList<2> ends(2, 0);
  for (const auto& panel : panels) {
    for (const auto* points : {&panel.place->points, &panel.place->control_points}) {
      if (points->cols() == 0) continue;
      const PointList<2> seen = view.project(*points);
      ends.conservativeResize(2, ends.cols() + 2);
      ends.rightCols(2) << seen.rowwise().minCoeff(), seen.rowwise().maxCoeff();
    }
  }
  return bounding_box(ends);
}

}  // namespace

std::string draw_panels(const DrawnModel& model, const std::vector<ModelPanel>& panels,
                        const ObliqueView& view, const WeightPictureOptions& options) {
  validate(options);
  const Box content = common_box(panels, view);
  const auto& first = panels.front();
  const bool has_bar = options.color_bar && panels.size() == 1 && first.control_point >= 0;
  const auto sheet = plan_sheet(content, static_cast<int>(panels.size()), options, has_bar);
  Canvas canvas(sheet.width, sheet.height, options.format);
  const Eigen::VectorXd plain;
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const auto& [label, place, values, control_point, before] = panels[k];
    const auto& frame = sheet.frames[k];
    const PixelMap map(content, frame);
    if (before) paint_ghost(canvas, {model, *before, plain, -1, view, map, sheet.unit});
    paint_model(canvas, {model, *place, values, control_point, view, map, sheet.unit});
    paint_label(canvas, {frame.center().x(), frame.low.y()}, label, sheet.unit);
  }
  if (has_bar) {
    auto without_lines = options;
    without_lines.isolines = 0;
    without_lines.support_level = 0;
    paint_color_bar(canvas, sheet.color_bar, first.control_point, first.values.minCoeff(),
                    first.values.maxCoeff(), without_lines);
  }
  return canvas.encode();
}

std::string draw_weights(const DrawnModel& model, const ModelPlace& place,
                         const Eigen::VectorXd& values, Index control_point,
                         const ObliqueView& view, const WeightPictureOptions& options) {
  const auto shared = std::make_shared<const ModelPlace>(place);
  return draw_panels(model, {{"", shared, values, control_point}}, view, options);
}

std::string draw_poses(const DrawnModel& model, const ModelPlace& rest, const ModelPlace& pose,
                       const ObliqueView& view, const WeightPictureOptions& options) {
  const auto shared = std::make_shared<const ModelPlace>(rest);
  ModelPanel posed{kPoseLabel, std::make_shared<const ModelPlace>(pose)};
  posed.before = shared;
  return draw_panels(model, {{kRestLabel, shared}, posed}, view, options);
}

}  // namespace flbc::draw
