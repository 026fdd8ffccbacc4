// SPDX-License-Identifier: BSD-3-Clause
// flbc convert: weights or meshes from one format to another.
#include <iostream>
#include <memory>

#include "commands/commands.h"
#include "files/load.h"
#include "files/movable_model.h"
#include "flbc/errors.h"
#include "flbc/io/weights_io.h"
#include "solve/weights_of_model.h"
#include "system/held_signals.h"

namespace flbc::app {
namespace {

struct ConvertArguments {
  std::string input;
  std::string output;
  std::string cage;        // of weights; empty = not known
  std::string points;      // model or mesh of weights; empty = not known
  bool transpose = false;  // the input has control points as rows
  bool quiet = false;
};

bool is_weight_file(const std::string& path) {
  return io::holds(path, {io::Content::kWeights});
}

void check_weight_arguments(const ConvertArguments& files) {
  if (io::holds(files.output, kMeshFiles))
    throw OptionError(files.output + ": weights cannot be written as a mesh; choose from " +
                      io::extensions_of({io::Content::kWeights}));
  require_writable(files.output, {io::Content::kWeights});
}

void check_mesh_arguments(const ConvertArguments& files) {
  if (!io::holds(files.input, kMeshFiles)) {
    throw OptionError(files.input + ": unknown file format; weights end in " +
                      io::extensions_of({io::Content::kWeights}) + ", meshes in " +
                      io::extensions_of(kMeshFiles) + io::conversion_hint(files.input));
  }
  if (is_weight_file(files.output))
    throw OptionError(files.output + ": a mesh cannot be written as weights; choose from " +
                      io::extensions_of(kMeshFiles));
  require_formats({files.input, files.output, false, true});
  if (files.transpose || !files.cage.empty() || !files.points.empty()) {
    throw OptionError("--cage, --points, and --transpose are for weights, but " + files.input +
                      " is a mesh");
  }
}

void check_arguments(const ConvertArguments& files) {
  if (is_weight_file(files.input)) {
    check_weight_arguments(files);
  } else {
    check_mesh_arguments(files);
  }
  require_distinct({files.input, files.cage, files.points}, {files.output});
}

SparseWeights load_weights(const ConvertArguments& files) {
  auto weights = io::read_weights(files.input);
  if (files.transpose) weights = WeightMatrix(weights.dense().transpose());
  const Index given_controls = weights.num_control_points(), given_points = weights.num_points();
  const Index num_controls = files.cage.empty() ? given_controls : count_vertices(files.cage);
  const Index num_points = files.points.empty() ? given_points : count_vertices(files.points);
  const bool is_turned = num_controls == given_points && num_points == given_controls;
  if (is_turned && num_controls != num_points) {
    throw InputError(files.input + (files.transpose
                                        ? ": has points as rows; leave out --transpose"
                                        : ": has control points as rows; give --transpose"));
  }
  check_sizes(weights, num_controls, num_points, {files.input, files.cage, files.points});
  return weights;
}

void convert_weights(const ConvertArguments& files) {
  const auto weights = load_weights(files);
  naming(files.input, [&] {
    const HeldSignals held;
    io::write_weights(files.output, weights);
  });
  if (files.quiet) return;
  std::cerr << files.output << ": weights of " << weights.num_points() << " points for "
            << weights.num_control_points() << " control points\n";
}

// Reports what the new format loses.
void convert_mesh(const ConvertArguments& files) {
  const auto convert = [&](const auto& any) {
    {
      const HeldSignals held;
      naming(files.input, [&] { any.write(files.output, any.points(), {}, 0); });
    }
    if (files.quiet) return;
    std::cerr << files.output << ": " << any.points().cols() << " vertices\n";
    any.print_losses();
  };
  std::visit(convert, load_any_model({files.input, files.output, false, true}));
}

}  // namespace

void add_convert_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<ConvertArguments>();
  auto& a = *arguments;
  auto* command =
      app.add_subcommand("convert", "convert weights, a mesh, or a model to another format");
  command->footer(
      "Weights: .mtx, .npy, .csv. Conversions between them are lossless. Also .lbw, for graphics\n"
      "cards: single precision, at most 8 influences per vertex (flbc sparsify -k 8).\n"
      "Models: .obj, .off, .ply, .stl, .glb; .om and .gltf are only read. Meshes: 2D .obj, .off; "
      "3D\n"
      ".mesh, .msh; .vtu is only written. The program reports attributes that the new format\n"
      "does not support. A .ply or .stl result is a text file if the input is.");
  command->add_option("IN", a.input, "file to convert")->required();
  command->add_option("-o,--output", a.output, "converted file, of the same kind as IN")
      ->required();
  command->add_option("--cage", a.cage,
                      "cage of the weights, to check the number of control points");
  command->add_option("--points", a.points,
                      "model or mesh of the weights, to check the number of vertices");
  command->add_flag("--transpose", a.transpose, "read control points as rows");
  command->add_flag("-q,--quiet", a.quiet, "print only errors");
  command->callback([arguments] {
    check_arguments(*arguments);
    is_weight_file(arguments->input) ? convert_weights(*arguments) : convert_mesh(*arguments);
  });
}

}  // namespace flbc::app
