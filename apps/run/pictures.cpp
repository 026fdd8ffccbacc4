// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>

#include "draw/model_picture.h"
#include "draw/plane_picture.h"
#include "draw/slice_picture.h"
#include "draw/view.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "report/facts.h"
#include "run/steps.h"

namespace flbc::app {
namespace {

// That of the control point which moves most of the shape, in the poses if there are any.
template <int Dim>
Index choose_control_point(const Run<Dim>& run) {
  if (run.arguments.control_point >= 0) return run.arguments.control_point;
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(run.cage.size());
  for (Index p = 0; p < run.weights().num_points(); ++p) {
    run.weights().visit(p, [&](Index i, double weight) { shares[i] += weight; });
  }
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(shares.size());
  for (const auto& pose : run.poses()) {
    const PointList<Dim> steps = pose.points - run.cage.points;
    moved += shares.cwiseProduct(steps.colwise().norm().transpose());
  }
  Eigen::Index chosen = 0;
  (moved.isZero(0) ? shares : moved).maxCoeff(&chosen);
  return static_cast<Index>(chosen);
}

template <int Dim>
draw::WeightPictureOptions options_of(const Run<Dim>& run) {
  draw::WeightPictureOptions options;
  options.format = draw::picture_format("picture." + run.arguments.pictures);
  return options;
}

std::string function_image(const Run<2>& run, Index control_point) {
  return draw::draw_weights(run.cage, run.solver.domain(),
                            run.solver.domain_weights().of_control_point(control_point),
                            control_point, options_of(run));
}

// The turn after which the model stands upright and faces the z axis.
Eigen::Matrix3d turn_to_front(const Run<3>& run) {
  const auto& points = run.shape().points;
  const int up = up_axis(run.arguments.up, points);
  const double front = front_azimuth(up, points) * draw::kDegree;
  return Eigen::AngleAxisd(-front, Vector<3>::UnitY()) * turn_upright(up);
}

// A cage or a mesh as slices are seen.
template <class Mesh>
Mesh turned(const Eigen::Matrix3d& turn, Mesh mesh) {
  mesh.points = (turn * mesh.points).eval();
  return mesh;
}

std::string function_image(const Run<3>& run, Index control_point) {
  const auto turn = turn_to_front(run);
  const auto model =
      turned(turn, Cage<3>{run.shape().points, gltf::triangles_of_points(run.shape().surface)});
  return draw::draw_slices(turned(turn, run.cage), turned(turn, run.solver.domain()),
                           run.solver.domain_weights().of_control_point(control_point),
                           control_point, 3, options_of(run),
                           model.facets.cols() > 0 ? &model : nullptr);
}

draw::ObliqueView usual_view(const Run<3>& run) {
  return draw::before_turn(draw::view_by_angles(draw::kUsualAzimuth, draw::kUsualElevation),
                           turn_to_front(run));
}

// The shape at rest by the sparse weights.
std::string draw_rest(const Run<2>& run, Index control_point) {
  return draw::draw_weights(
      run.cage, {run.shape().points, gltf::triangles_of_points(run.shape().surface)},
      run.reduced.of_control_point(control_point), control_point, options_of(run));
}

std::string draw_rest(const Run<3>& run, Index control_point) {
  return draw::draw_model({gltf::triangles_of_points(run.shape().surface), shown_cage(run).edges},
                          {{run.cage.points, run.shape().points}},
                          {run.reduced.of_control_point(control_point), control_point},
                          usual_view(run), options_of(run));
}

template <int Dim>
void add_picture(Run<Dim>& run, const char* title, const std::string& facts,
                 const std::string& picture) {
  const auto name = std::string(title) + "." + run.arguments.pictures;
  run.folder.add_text(name, facts, picture);
  run.report["pictures"]["files"].push_back(name);
}

// The shape at rest and in the pose; the mesh of the interior in place of one without triangles.
std::string deformation_image(const Run<2>& run, const Pose<2>& pose, Index control_point) {
  const auto& shape = run.shape();
  const auto& domain = run.solver.domain();
  const bool is_surface = shape.surface.triangles.cols() > 0;
  const auto& points = is_surface ? shape.points : domain.points;
  const PointList<2> posed =
      is_surface ? run.moved.at(pose.points) : deform<2>(run.solver.domain_weights(), pose.points);
  return draw::draw_deformation(
      run.cage.facets, is_surface ? gltf::triangles_of_points(shape.surface) : domain.cells,
      {run.cage.points, points}, {pose.points, posed}, {}, control_point, options_of(run));
}

// The shape at rest and in the pose; slices through the mesh of the interior
// in place of one without triangles.
std::string deformation_image(const Run<3>& run, const Pose<3>& pose, Index control_point) {
  const auto& shape = run.shape();
  if (shape.surface.triangles.cols() == 0) {
    const auto& weights = run.solver.domain_weights();
    const DomainMesh<3> moved{deform<3>(weights, pose.points), run.solver.domain().cells};
    const auto turn = turn_to_front(run);
    return draw::draw_slices(turned(turn, Cage<3>{pose.points, run.cage.facets}),
                             turned(turn, moved), weights.of_control_point(control_point),
                             control_point, 3, options_of(run));
  }
  const PointList<3> points = run.moved.at(pose.points);
  return draw::draw_model({gltf::triangles_of_points(shape.surface), shown_cage(run).edges},
                          {{run.cage.points, shape.points}, {pose.points, points}}, {},
                          usual_view(run), options_of(run));
}

template <int Dim>
void draw_farthest_pose(Run<Dim>& run, Index control_point) {
  const auto& pose = run.poses()[run.displacement.pose];
  Facts facts;
  facts << "at rest and in " << pose.name;
  try {
    add_picture(run, kDeformation, facts.text(), deformation_image(run, pose, control_point));
  } catch (const InputError& error) {  // in a pose all control points may coincide
    run.report["pictures"]["left_out"] = error.what();
    run.folder.print(kDeformation, std::string("left out: ") + error.what());
  }
}

}  // namespace

template <int Dim>
void draw_function(Run<Dim>& run) {
  const Index control_point = choose_control_point(run);
  run.report["pictures"] = {{"control_point", control_point}};
  Facts facts;
  facts << "the coordinate function of control point " << control_point;
  add_picture(run, kFunction, facts.text(), function_image(run, control_point));
}

template <int Dim>
void draw_shape(Run<Dim>& run) {
  const auto control_point = run.report["pictures"]["control_point"].template get<Index>();
  if (!run.poses().empty()) {
    draw_farthest_pose(run, control_point);
  } else if (run.shape().surface.triangles.cols() > 0) {
    add_picture(run, kModelPicture, "at rest, with its weights for this control point",
                draw_rest(run, control_point));
  }
}

#define FLBC_INSTANTIATE(Dim)             \
  template void draw_function(Run<Dim>&); \
  template void draw_shape(Run<Dim>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::app
