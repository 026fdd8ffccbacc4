// SPDX-License-Identifier: BSD-3-Clause
// flbc convert: weights or meshes from one format to another.
#include <iostream>
#include <memory>

#include "commands/commands.h"
#include "files/convert_weights.h"
#include "files/held_signals.h"
#include "files/load.h"
#include "files/movable_model.h"
#include "flbc/errors.h"

namespace flbc::app {
namespace {

struct ConvertArguments {
  WeightConversion files;
  bool quiet = false;
};

void check_weight_arguments(const WeightConversion& files) {
  if (io::holds(files.output, kMeshFiles))
    throw OptionError(files.output + ": weights are no mesh");
  require_writable(files.output, kWeightFiles);
}

void check_mesh_arguments(const WeightConversion& files) {
  if (!io::holds(files.input, kMeshFiles)) {
    throw OptionError(files.input + ": cannot tell the format; weights end in " +
                      io::extensions_of(kWeightFiles) + ", meshes in " +
                      io::extensions_of(kMeshFiles));
  }
  if (is_weight_file(files.output)) throw OptionError(files.output + ": a mesh is no weights");
  require_formats({files.input, files.output, false, true});
  if (files.transpose || !files.cage.empty() || !files.points.empty()) {
    throw OptionError("--cage, --points, and --transpose are for weights, but " +
                      files.input + " is a mesh");
  }
}

void check_arguments(const ConvertArguments& arguments) {
  const auto& files = arguments.files;
  if (is_weight_file(files.input)) {
    check_weight_arguments(files);
  } else {
    check_mesh_arguments(files);
  }
  auto inputs = files_of_model(files.input);
  inputs.insert(inputs.end(), {files.cage, files.points});
  for (const auto& output : files_of_model(files.output)) require_distinct(inputs, {output});
}

// Losses of the new format are told.
void convert_mesh(const std::string& input, const std::string& output, bool quiet) {
  const auto convert = [&](const auto& any) {
    {
      const HeldSignals held;
      naming(input, [&] { any.write(output, any.points(), {}, 0); });
    }
    if (quiet) return;
    std::cerr << output << ": " << any.points().cols() << " vertices\n";
    any.print_losses();
  };
  std::visit(convert, load_any_model({input, output, false, true}));
}

}  // namespace

void add_convert_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<ConvertArguments>();
  auto& a = arguments->files;
  auto* command =
      app.add_subcommand("convert", "Write weights, a mesh or a model in another format");
  command->footer(
      "Weights: .mtx, .dmat, .npy, and .txt with \"CONTROL_POINT POINT WEIGHT\" on every line,\n"
      "numbered from 0. They become each other without loss.\n"
      "Models: .obj, .off, .ply, .stl, .om. Meshes: 2D .obj, .off, .vtu; 3D .mesh, .node, .ele,\n"
      ".msh, .vtu. What the new format has no place for is told. A .ply or .stl result is text if\n"
      "the model's file is.");
  command->add_option("IN", a.input, "what to convert; the extension tells its kind")->required();
  command->add_option("-o,--output", a.output, "a file of the same kind")->required();
  command->add_option("--cage", a.cage, "the cage of the weights: checks their number");
  command->add_option("--points", a.points,
                      "model or mesh whose vertices the weights belong to: checks their number");
  command->add_flag("--transpose", a.transpose,
                    "IN has control points as rows (.txt: \"POINT CONTROL_POINT WEIGHT\")");
  command->add_flag("-q,--quiet", arguments->quiet, "print nothing but errors");
  command->callback([arguments] {
    check_arguments(*arguments);
    const auto& files = arguments->files;
    if (is_weight_file(files.input)) {
      convert_weights(files, arguments->quiet);
    } else {
      convert_mesh(files.input, files.output, arguments->quiet);
    }
  });
}

}  // namespace flbc::app
