// SPDX-License-Identifier: BSD-3-Clause
#include "draw/slice_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "draw/layout.h"
#include "draw/scene.h"
#include "draw/weight_painter.h"
#include "flbc/bounding_box.h"
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

ObliqueView view_of(const Plane& plane) {
  int axis = 0;
  plane.normal.maxCoeff(&axis);
  return view_of_slices(axis);
}

// Panels stand where the view leaves room.
Strip choose_strip(const Box& content, const WeightPictureOptions& options) {
  if (!options.slice_panels) return Strip::kNone;
  return content.size().y() > 1.25 * content.size().x() ? Strip::kBeside : Strip::kBelow;
}

std::vector<Slice> cut_all(const Cage<3>& cage, const DomainMesh<3>& mesh,
                           const Eigen::VectorXd& values, Index control_point, int number,
                           const Cage<3>* model = nullptr) {
  std::vector<Slice> slices;
  for (const Plane& plane : choose_planes(cage, mesh, values, control_point, number)) {
    slices.push_back(cut(cage, mesh, values, plane));
    if (model != nullptr) slices.back().section = section_of(*model, plane);
  }
  return slices;
}

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

// Writes a letter above a slice.
void paint_letter(Canvas& canvas, const Slice& slice, std::size_t k,
                  const std::function<Vector<2>(const Vector<2>&)>& pixel, double unit) {
  PointList<2> pixels(2, slice.mesh.num_vertices());
  for (Index v = 0; v < slice.mesh.num_vertices(); ++v) {
    pixels.col(v) = pixel(slice.mesh.points.col(v));
  }
  Eigen::Index top = 0;
  pixels.row(1).minCoeff(&top);
  paint_label(canvas, pixels.col(top), std::string(1, static_cast<char>('A' + k)), unit);
}

// The letters in the oblique view, on top of all.
void paint_letters(Canvas& canvas, const Scene& scene, const Box& strip) {
  const auto slices = in_reading_order(scene, strip.size().x() > strip.size().y());
  for (std::size_t k = 0; k < slices.size(); ++k) {
    const Slice& slice = *slices[k];
    paint_letter(
        canvas, slice, k, [&](const Vector<2>& p) { return scene.pixel(slice.plane.to_space(p)); },
        scene.unit);
  }
}

// Paints all slices, seen from straight before them, in a row (if the strip is wider than high) or
// a column, at one scale and in their order in the scene, from the left or from the top.
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
    paint_letter(canvas, slice, k, pixel, scene.unit);
    if (std::abs(slice.plane.distance(highlighted)) < near) {
      paint_dots(canvas, {pixel(slice.plane.to_plane(highlighted))}, 7 * scene.unit, kHighlight);
    }
  }
}

void paint_slices(Canvas& canvas, const Scene& scene, Index control_point) {
  const Raster model = paint_scene(canvas, scene);
  // On top of all, because it is what the picture is about; pale behind the model.
  const Vector<3> place = scene.cage.points.col(control_point);
  const Vector<2> pixel = scene.pixel(place);
  const bool is_hidden = model.hides(pixel, scene.view.toward.dot(place));
  paint_dots(canvas, {pixel}, 9 * scene.unit, is_hidden ? kHiddenHighlight : kHighlight);
}

}  // namespace

std::string draw_slices(const Cage<3>& cage, const DomainMesh<3>& mesh,
                        const Eigen::VectorXd& values, Index control_point, int number_of_slices,
                        const WeightPictureOptions& options, const Cage<3>* model) {
  validate(options);
  check_arguments(cage, number_of_slices);
  check_weight(values, mesh.num_vertices(), control_point, cage.size());

  const auto slices = cut_all(cage, mesh, values, control_point, number_of_slices, model);
  const ObliqueView view = view_of(slices.front().plane);
  const Box content = bounding_box(view.project(cage.points));
  const Strip strip = choose_strip(content, options);
  const PictureLayout layout = plan_picture(content, options, strip);
  const Scene scene{
      cage,    slices, view, PixelMap(content, layout.frame), std::max(0.6, pixel_unit(options)),
      options, model};

  Canvas canvas(layout.width, layout.height, options.format);
  paint_slices(canvas, scene, control_point);
  if (strip != Strip::kNone) {
    paint_panels(canvas, scene, layout.strip, control_point);
    paint_letters(canvas, scene, layout.strip);
  }
  if (options.color_bar) {
    paint_color_bar(canvas, layout.color_bar, control_point, values.minCoeff(), values.maxCoeff(),
                    options);
  }
  return canvas.encode();
}

std::string draw_slice_sheet(const Cage<3>& cage, const DomainMesh<3>& mesh,
                             const WeightMatrix& weights, int number_of_slices,
                             const WeightPictureOptions& options) {
  validate(options);
  check_arguments(cage, number_of_slices);
  if (weights.rows() != cage.size()) {
    throw InputError("there are weights of " + std::to_string(weights.rows()) +
                     " control points, but the cage has " + std::to_string(cage.size()));
  }
  // Seen from where most slices are seen well, whatever the control point.
  const ObliqueView usual = view_by_angles(kUsualAzimuth, kUsualElevation);
  auto small = options;
  small.isolines = options.isolines / 2;  // more would hide the colors
  const auto sheet = plan_sheet(bounding_box(usual.project(cage.points)), cage.size(), options);
  Canvas canvas(sheet.width, sheet.height, options.format);
  for (Index i = 0; i < cage.size(); ++i) {
    const Eigen::VectorXd values = weights.row(i);
    check_weight(values, mesh.num_vertices(), i, cage.size());
    const auto slices = cut_all(cage, mesh, values, i, number_of_slices);
    const ObliqueView view = view_of(slices.front().plane);
    const PixelMap map(bounding_box(view.project(cage.points)), sheet.frames[i]);
    paint_slices(canvas, {cage, slices, view, map, std::max(0.4, 0.5 * pixel_unit(options)), small},
                 i);
    paint_symbol(canvas, sheet.label(i), i, sheet.label_height);
  }
  return canvas.encode();
}

}  // namespace flbc::draw
