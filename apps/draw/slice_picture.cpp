// SPDX-License-Identifier: BSD-3-Clause
#include "draw/slice_picture.h"

#include <algorithm>
#include <string>
#include <vector>

#include "draw/layout.h"
#include "draw/model_view.h"
#include "draw/scene.h"
#include "draw/slice_panels.h"
#include "draw/weight_painter.h"
#include "flbc/errors.h"

namespace flbc::draw {
namespace {

void check_arguments(const Cage<3>& cage, int number_of_slices) {
  if (number_of_slices < 1 || number_of_slices > 50) {
    throw OptionError("the number of slices must be 1 to 50, not " +
                      std::to_string(number_of_slices));
  }
  if (cage.facets.size() == 0 || cage.facets.minCoeff() < 0 ||
      cage.facets.maxCoeff() >= cage.size()) {
    throw InputError(
        "the cage has no facets, or one refers to a control point that does not exist");
  }
}

ObliqueView choose_view(const Cage<3>& cage, const Plane& plane, Index control_point) {
  int axis = 0;
  plane.normal.maxCoeff(&axis);
  const Vector<3> center =
      (cage.points.rowwise().minCoeff() + cage.points.rowwise().maxCoeff()) / 2;
  return view_of_slices(axis, cage.points.col(control_point) - center);
}

// Panels stand where the view leaves room.
Strip choose_strip(const Box& content, const WeightPictureOptions& options) {
  if (!options.slice_panels) return Strip::kNone;
  return content.size().y() > 1.25 * content.size().x() ? Strip::kBeside : Strip::kBelow;
}

std::vector<Slice> cut_all(const Cage<3>& cage, const DomainMesh<3>& mesh,
                           const Eigen::VectorXd& values, Index control_point, int number) {
  std::vector<Slice> slices;
  for (const Plane& plane : choose_planes(cage, mesh, values, control_point, number)) {
    slices.push_back(cut(cage, mesh, values, plane));
  }
  return slices;
}

void paint_slices(Canvas& canvas, const Scene& scene, Index control_point) {
  paint_scene(canvas, scene);
  // On top of all, wherever it is: it is what the picture is about.
  paint_dot(canvas, scene.pixel(scene.cage.points.col(control_point)), 9 * scene.unit, kHighlight);
}

}  // namespace

Image draw_slices(const Cage<3>& cage, const DomainMesh<3>& mesh, const Eigen::VectorXd& values,
                  Index control_point, int number_of_slices, const WeightPictureOptions& options) {
  validate(options);
  check_arguments(cage, number_of_slices);
  check_weight(values, mesh.num_vertices(), control_point, cage.size());

  const auto slices = cut_all(cage, mesh, values, control_point, number_of_slices);
  const ObliqueView view = choose_view(cage, slices.front().plane, control_point);
  const Box content = bounding_box(view.project(cage.points));
  const Strip strip = choose_strip(content, options);
  const PictureLayout layout = plan_picture(content, options, strip);
  const Scene scene{
      cage,   slices, view, PixelMap(content, layout.frame), std::max(0.6, pixel_unit(options)),
      options};

  Canvas canvas = new_canvas(layout.width, layout.height, options);
  paint_slices(canvas, scene, control_point);
  if (strip != Strip::kNone) paint_panels(canvas, scene, layout.strip, control_point);
  if (options.color_bar) {
    paint_color_bar(canvas, layout.color_bar, control_point, values.minCoeff(), values.maxCoeff(),
                    options);
  }
  return canvas.resolve();
}

Image draw_slice_sheet(const Cage<3>& cage, const DomainMesh<3>& mesh, const WeightMatrix& weights,
                       int number_of_slices, const WeightPictureOptions& options) {
  validate(options);
  check_arguments(cage, number_of_slices);
  if (weights.rows() != cage.size()) {
    throw InputError("there are weights of " + std::to_string(weights.rows()) +
                     " control points, but the cage has " + std::to_string(cage.size()));
  }
  // Seen from where most slices are seen well, whatever the control point.
  const ObliqueView usual = view_by_angles(kUsualAzimuth, kUsualElevation);
  auto small = options;
  small.isolines = options.isolines / 2;  // more would hide the colours
  const auto sheet = plan_sheet(bounding_box(usual.project(cage.points)), cage.size(), options);
  Canvas canvas = new_canvas(sheet.width, sheet.height, options);
  for (Index i = 0; i < cage.size(); ++i) {
    const Eigen::VectorXd values = weights.row(i);
    check_weight(values, mesh.num_vertices(), i, cage.size());
    const auto slices = cut_all(cage, mesh, values, i, number_of_slices);
    const ObliqueView view = choose_view(cage, slices.front().plane, i);
    const PixelMap map(bounding_box(view.project(cage.points)), sheet.frames[i]);
    paint_slices(canvas,
                 {cage, slices, view, map, std::max(0.4, 0.5 * pixel_unit(options)), small}, i);
    paint_symbol(canvas, sheet.label(i), i, sheet.label_height);
  }
  return canvas.resolve();
}

}  // namespace flbc::draw
