// SPDX-License-Identifier: BSD-3-Clause
// flbc draw: a coordinate function as a picture.
#include <iostream>
#include <memory>

#include "commands/commands.h"
#include "draw/png_writer.h"
#include "draw/slice_picture.h"
#include "draw/weight_picture.h"
#include "files/held_signals.h"
#include "files/load.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/weights_io.h"
#include "solve/weights_of_model.h"

namespace flbc::app {
namespace {

struct DrawArguments {
  std::string domain;
  std::string weights;
  std::string cage;
  std::string output;
  Index control_point = 0;
  int slices = 3;
  bool all = false;
  draw::WeightPictureOptions options;
};

draw::Image picture(const Cage<2>& cage, const DomainMesh<2>& domain, const WeightMatrix& weights,
                    const DrawArguments& arguments) {
  if (!arguments.all) {
    return draw::draw_weights(cage, domain, weights.row(arguments.control_point),
                              arguments.control_point, arguments.options);
  }
  std::vector<Index> control_points;
  for (Index i = 0; i < cage.size(); ++i) control_points.push_back(i);
  return draw::draw_all(cage, domain, weights, control_points, arguments.options);
}

draw::Image picture(const Cage<3>& cage, const DomainMesh<3>& domain, const WeightMatrix& weights,
                    const DrawArguments& arguments) {
  if (arguments.all) throw OptionError("--all draws 2D coordinates only");
  return draw::draw_slices(cage, domain, weights.row(arguments.control_point),
                           arguments.control_point, arguments.slices, arguments.options);
}

template <int Dim>
void draw_cage(const Cage<Dim>& cage, const DrawArguments& arguments) {
  const auto domain = io::read_domain<Dim>(arguments.domain);
  const auto weights = io::read_weights(arguments.weights);
  check_sizes(weights, cage.size(), domain.num_vertices(),
              {arguments.weights, arguments.cage, arguments.domain});
  if (arguments.control_point < 0 || arguments.control_point >= cage.size()) {
    throw OptionError("--control-point must be in [0, " + std::to_string(cage.size() - 1) +
                      "], not " + std::to_string(arguments.control_point));
  }
  const auto png = draw::encode_png(picture(cage, domain, weights, arguments));
  const HeldSignals held;
  io::write_file(arguments.output, [&](std::ostream& file) { file << png; });
}

}  // namespace

void add_draw_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<DrawArguments>();
  auto& a = *arguments;
  auto* command = app.add_subcommand("draw", "Draw a coordinate function as a picture");
  command->add_option("DOMAIN", a.domain, "mesh (see flbc solve --save-domain)")->required();
  command->add_option("--weights", a.weights, "weights at its vertices")->required();
  command->add_option("--cage", a.cage, "the cage they belong to")->required();
  command->add_option("-o,--output", a.output, "the picture, .png")->required();
  auto* point =
      command->add_option("--control-point", a.control_point, "which function, from 0 (0)");
  command->add_flag("--all", a.all, "a sheet of all functions (2D)")->excludes(point);
  command->add_option("--slices", a.slices, "number of slices (3D) (3)");
  command->add_option("--width", a.options.width, "width in pixels (1200)");
  command->add_option("--isolines", a.options.isolines, "number of isolines between 0 and 1 (10)");
  command->add_flag("--mesh", a.options.mesh_edges, "show the mesh");
  command->callback([arguments] {
    draw::validate(arguments->options);
    require_writable(arguments->output, "png");
    std::visit([&](const auto& cage) { draw_cage(cage, *arguments); }, load_cage(arguments->cage));
  });
}

}  // namespace flbc::app
