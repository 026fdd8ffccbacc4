// SPDX-License-Identifier: BSD-3-Clause
// flbc draw: coordinate functions and deformations as pictures.
#include <memory>
#include <numeric>

#include "commands/commands.h"
#include "draw/model_picture.h"
#include "draw/plane_picture.h"
#include "files/upright.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/weights_io.h"
#include "front/bound_model.h"
#include "front/load.h"
#include "front/model_page.h"
#include "front/poses.h"
#include "help/options.h"

namespace flbc::app {
namespace {

struct DrawArguments {
  std::string model;  // or a domain mesh
  BindingFiles files;
  std::string pose;
  std::string output;
  std::string color;
  ModelView view;
  Index control_point = 0;
  bool all = false;
  draw::WeightPictureOptions options;
};

constexpr const char* kDisplacement = "displacement";
constexpr const char* kWeight = "weight";
constexpr const char* kPlain = "plain";

void check_arguments(DrawArguments& arguments) {
  draw::validate(arguments.options);
  arguments.options.format = draw::picture_format(arguments.output);
  require_writable(arguments.output, io::extension_of(arguments.output).c_str());
  if (arguments.model.empty()) throw OptionError("give MODEL, a model or a domain mesh");
  if (arguments.color == kDisplacement && arguments.pose.empty()) {
    throw OptionError("--color displacement needs --pose, the deformed cage");
  }
}

std::vector<Index> all_of(Index count) {
  std::vector<Index> control_points(count);
  std::iota(control_points.begin(), control_points.end(), 0);
  return control_points;
}

// A model at rest and, with a pose, also there.
template <int Dim>
struct PosedModel {
  view::ShownModel<Dim> model;
  SparseWeights weights;
  Cage<Dim> cage;
  std::vector<std::array<Index, 2>> edges;  // of the cage, as its file has them
  PointList<Dim> pose{};                    // of the cage; empty without one
  PointList<Dim> moved{};                   // the model's points in the pose
};

template <int Dim>
PosedModel<Dim> load_posed(const DrawArguments& arguments) {
  auto model = load_shown_model<Dim>(arguments.model);
  const auto& files = arguments.files;
  const auto binding =
      load_binding<Dim>(files, arguments.model, model.points, {}, !arguments.pose.empty());
  require_control_point(arguments.control_point, binding.cage.size());
  PosedModel<Dim> posed{std::move(model), binding.weights, binding.cage,
                        shown_cage_of(files, binding).edges};
  if (arguments.pose.empty()) return posed;
  posed.pose = rest_cage_of(files, binding).load_pose(arguments.pose);
  posed.moved = binding.deform(posed.pose);
  return posed;
}

std::string picture_2d(const DrawArguments& arguments) {
  const bool has_squares = !arguments.pose.empty() && !arguments.all && arguments.color != kWeight;
  if (arguments.color == kDisplacement || (arguments.color == kPlain && !has_squares)) {
    throw OptionError("--color " + arguments.color + " is for models in 3D");
  }
  const auto posed = load_posed<2>(arguments);
  const auto& cage = posed.cage;
  up_axis(arguments.view.up, posed.model.points);
  const DomainMesh<2> shape{posed.model.points, gltf::triangles_of_points(posed.model.surface)};
  const auto& weights = posed.weights;
  const Index i = arguments.control_point;
  if (arguments.all) {
    return draw::draw_all(cage, shape, weights.dense(), all_of(cage.size()), arguments.options);
  }
  const auto values = weights.of_control_point(i);
  if (arguments.pose.empty()) return draw::draw_weights(cage, shape, values, i, arguments.options);
  return draw::draw_deformation(cage.facets, shape.cells, {cage.points, shape.points},
                                {posed.pose, posed.moved}, has_squares ? Eigen::VectorXd() : values,
                                i, arguments.options);
}

draw::ShownValues shown_values(const PosedModel<3>& posed, const DrawArguments& arguments) {
  const bool has_moved = posed.moved.cols() > 0;
  const auto color = !arguments.color.empty() ? arguments.color : has_moved ? kPlain : kWeight;
  if (color == kPlain) return {};
  if (color == kDisplacement) return {displacements<3>(posed.model.points, posed.moved)};
  return {posed.weights.of_control_point(arguments.control_point), arguments.control_point};
}

std::string picture_3d(const DrawArguments& arguments) {
  const auto posed = load_posed<3>(arguments);
  const auto& cage = posed.cage;
  const auto view = view_of(arguments.view, posed.model.points);
  const draw::DrawnModel model{gltf::triangles_of_points(posed.model.surface), posed.edges};
  std::vector<draw::ModelPlace> places{{cage.points, posed.model.points}};
  if (arguments.all) {
    return draw::draw_model_sheet(model, places[0], posed.weights.dense(), view, arguments.options);
  }
  if (posed.moved.cols() > 0) places.push_back({posed.pose, posed.moved});
  return draw::draw_model(model, places, shown_values(posed, arguments), view, arguments.options);
}

void add_options(CLI::App& command, DrawArguments& a) {
  auto* model =
      command.add_option("MODEL", a.model, "model or domain mesh; in 3D its surface is drawn");
  command.add_option("--model", a.model)->excludes(model)->group("");  // of earlier versions
  command.add_option("--weights", a.files.weights, describe_weight_file())->required();
  add_cage_option(command, a.files.cage);
  command.add_option("-o,--output", a.output, std::string("picture: ") + draw::kPictureExtensions)
      ->required();
  auto* point =
      command.add_option("--control-point", a.control_point,
                         "control point whose function is drawn, counted from 0 (default: 0)");
  command.add_option("--pose", a.pose, "deformed cage: draw the model at rest and in this pose");
  add_choice(command, "--color", {kDisplacement, kWeight, kPlain}, a.color,
             "what the colors of the model show (default: weight, or plain with --pose)");
  add_view_options(command, a.view);
  command.add_flag("--all", a.all, "draw all functions on one sheet")->excludes(point);
  command.add_option("--width", a.options.width, "width in pixels (default: 1200)");
  command.add_option("--isolines", a.options.isolines,
                     "number of isolines between 0 and 1 in 2D (default: 10)");
}

}  // namespace

void add_draw_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<DrawArguments>();
  auto* command = app.add_subcommand("draw", "draw a coordinate function, or a model and its pose");
  command->footer(
      "In 2D the colors fill the domain, in 3D they are on the surface of the model. For sections\n"
      "of the inside, open the mesh of flbc solve --save-domain domain.vtu in ParaView: each\n"
      "coordinate function is a field.");
  add_options(*command, *arguments);
  command->callback([arguments] {
    check_arguments(*arguments);
    arguments->view.up = up_of(arguments->view.up, arguments->model);
    require_cage(arguments->files);
    const auto picture =
        dimension_of(arguments->files) == 2 ? picture_2d(*arguments) : picture_3d(*arguments);
    write_text(arguments->output, picture);
  });
}

}  // namespace flbc::app
