// SPDX-License-Identifier: BSD-3-Clause
// flbc draw: coordinate functions and deformations as pictures.
#include <memory>

#include "commands/commands.h"
#include "draw/model_picture.h"
#include "draw/plane_picture.h"
#include "draw/view.h"
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
  UpAxis up = UpAxis::kAuto;
  Index control_point = 0;
  bool all = false;
  draw::WeightPictureOptions options;
};

void check_arguments(DrawArguments& arguments) {
  draw::validate(arguments.options);
  arguments.options.format = draw::picture_format(arguments.output);
  require_writable(arguments.output, io::extension_of(arguments.output).c_str());
  if (arguments.model.empty()) throw OptionError("MODEL is missing, a model or a domain mesh");
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

std::string label_of(Index control_point) {
  return "w" + std::to_string(control_point);
}

std::string picture_2d(const DrawArguments& arguments) {
  const auto posed = load_posed<2>(arguments);
  const auto& cage = posed.cage;
  up_axis(arguments.up, posed.model.points);
  const DomainMesh<2> shape{posed.model.points, gltf::triangles_of_points(posed.model.surface)};
  const Index i = arguments.control_point;
  const draw::DrawnShape rest{cage.points, shape.points};
  if (arguments.all) {
    const auto place = std::make_shared<const draw::DrawnShape>(rest);
    std::vector<draw::PlanePanel> panels;
    for (Index k = 0; k < cage.size(); ++k) {
      panels.push_back({label_of(k), place, posed.weights.of_control_point(k), k});
    }
    return draw::draw_panels(cage.facets, shape.cells, panels, shape.points, arguments.options);
  }
  if (!arguments.pose.empty()) {
    return draw::draw_poses(cage.facets, shape.cells, rest, {posed.pose, posed.moved},
                            arguments.options);
  }
  return draw::draw_weights(cage, shape, posed.weights.of_control_point(i), i, arguments.options);
}

std::string picture_3d(const DrawArguments& arguments) {
  const auto posed = load_posed<3>(arguments);
  const auto view = draw::view_of(arguments.up, posed.model.points);
  const draw::DrawnModel model{gltf::triangles_of_points(posed.model.surface), posed.edges};
  const draw::ModelPlace rest{posed.cage.points, posed.model.points};
  if (arguments.all) {
    const auto place = std::make_shared<const draw::ModelPlace>(rest);
    std::vector<draw::ModelPanel> panels;
    for (Index k = 0; k < posed.cage.size(); ++k) {
      panels.push_back({label_of(k), place, posed.weights.of_control_point(k), k});
    }
    return draw::draw_panels(model, panels, view, arguments.options);
  }
  const Index i = arguments.control_point;
  if (arguments.pose.empty()) {
    return draw::draw_weights(model, rest, posed.weights.of_control_point(i), i, view,
                              arguments.options);
  }
  return draw::draw_poses(model, rest, {posed.pose, posed.moved}, view, arguments.options);
}

void add_options(CLI::App& command, DrawArguments& a) {
  auto* model = command.add_option("MODEL", a.model,
                                   "model or domain mesh (required); in 3D its surface is drawn");
  command.add_option("--model", a.model)->excludes(model)->group("");  // of earlier versions
  command.add_option("--weights", a.files.weights, describe_weight_file())->required();
  add_cage_option(command, a.files.cage);
  command.add_option("-o,--output", a.output, std::string("picture: ") + draw::kPictureExtensions)
      ->required();
  auto* point =
      command.add_option("--control-point", a.control_point,
                         "control point whose function is drawn, counted from 0 (default: 0)");
  command.add_option("--pose", a.pose, "deformed cage: draw the model at rest and in this pose");
  add_up_option(command, a.up);
  command.add_flag("--all", a.all, "draw all functions on one sheet")->excludes(point);
  command.add_option("--width", a.options.width, "width in pixels (default: 1200)");
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
    arguments->up = up_of(arguments->up, arguments->model);
    require_cage(arguments->files);
    const auto picture =
        dimension_of(arguments->files) == 2 ? picture_2d(*arguments) : picture_3d(*arguments);
    write_text(arguments->output, picture);
  });
}

}  // namespace flbc::app
