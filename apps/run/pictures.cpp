// SPDX-License-Identifier: BSD-3-Clause
#include "draw/model_picture.h"
#include "draw/plane_picture.h"
#include "draw/view.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "front/facts.h"
#include "front/instantiate.h"
#include "run/steps.h"

namespace flbc::app {
namespace {

template <int Dim>
draw::WeightPictureOptions options_of(const Run<Dim>& run) {
  draw::WeightPictureOptions options;
  options.format = draw::picture_format("picture." + run.arguments.pictures);
  return options;
}

// What pictures show: the shape, or the mesh of the interior in place of one without triangles.
template <int Dim>
struct Drawn {
  const PointList<Dim>& points;
  CellList<2> triangles;
  const SparseWeights& weights;
};

template <int Dim>
Drawn<Dim> drawn_mesh(const Run<Dim>& run) {
  const auto& domain = run.solver.domain();
  return {domain.points, gltf::triangles_of_points(shape_of(domain).surface),
          run.solver.domain_weights()};
}

template <int Dim>
Drawn<Dim> drawn_shape(const Run<Dim>& run) {
  const auto& shape = run.shape();
  if (shape.surface.triangles.cols() == 0) return drawn_mesh(run);
  return {shape.points, gltf::triangles_of_points(shape.surface), run.weights()};
}

std::string function_image(const Run<2>& run, Index control_point) {
  const auto [points, triangles, weights] = drawn_mesh(run);
  return draw::draw_weights(run.cage, {points, triangles}, weights.of_control_point(control_point),
                            control_point, options_of(run));
}

draw::ObliqueView usual_view(const Run<3>& run) {
  return draw::view_of(run.arguments.up, run.shape().points);
}

std::string function_image(const Run<3>& run, Index control_point) {
  const auto [points, triangles, weights] = drawn_shape(run);
  return draw::draw_weights({triangles, shown_cage(run).edges}, {run.cage.points, points},
                            weights.of_control_point(control_point), control_point, usual_view(run),
                            options_of(run));
}

template <int Dim>
void add_picture(Run<Dim>& run, const char* title, const std::string& facts,
                 const std::string& picture) {
  const auto name = std::string(title) + "." + run.arguments.pictures;
  run.folder.add_text(name, facts, picture);
  run.report["pictures"]["files"].push_back(name);
}

// The points in a pose, as deformed files have them.
template <int Dim>
PointList<Dim> posed(const Run<Dim>& run, const Drawn<Dim>& drawn, const Pose<Dim>& pose) {
  return &drawn.points == &run.shape().points ? run.reduced.deform(pose.points)
                                              : deform<Dim>(drawn.weights, pose.points);
}

std::string deformation_image(const Run<2>& run, const Pose<2>& pose) {
  const auto drawn = drawn_shape(run);
  const draw::DrawnShape rest{run.cage.points, drawn.points};
  const draw::DrawnShape moved{pose.points, posed(run, drawn, pose)};
  return draw::draw_poses(run.cage.facets, drawn.triangles, rest, moved, options_of(run));
}

std::string deformation_image(const Run<3>& run, const Pose<3>& pose) {
  const auto drawn = drawn_shape(run);
  return draw::draw_poses({drawn.triangles, shown_cage(run).edges}, {run.cage.points, drawn.points},
                          {pose.points, posed(run, drawn, pose)}, usual_view(run), options_of(run));
}

}  // namespace

template <int Dim>
void draw_function(Run<Dim>& run) {
  const Index given = run.arguments.control_point;
  const Index control_point =
      given >= 0 ? given : main_control_point(run.weights(), run.cage.points, run.poses());
  run.report["pictures"] = {{"control_point", control_point}};
  Facts facts;
  facts << "the coordinate function of control point " << control_point;
  add_picture(run, kFunction, facts.text(), function_image(run, control_point));
}

template <int Dim>
void draw_farthest_pose(Run<Dim>& run) {
  if (run.poses().empty()) return;
  const auto& pose = run.poses()[run.displacement.pose];
  Facts facts;
  facts << "at rest and in " << pose.name;
  try {
    add_picture(run, kDeformation, facts.text(), deformation_image(run, pose));
  } catch (const InputError& error) {  // in a pose all control points may coincide
    run.report["pictures"]["left_out"] = error.what();
    run.folder.print(kDeformation, std::string("left out: ") + error.what());
  }
}

FLBC_INSTANTIATE_FUNCTION(draw_function)
FLBC_INSTANTIATE_FUNCTION(draw_farthest_pose)

}  // namespace flbc::app
