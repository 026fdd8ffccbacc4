// SPDX-License-Identifier: BSD-3-Clause
// flbc convert: weights or meshes from one format to another.
#include <iostream>
#include <memory>

#include "commands/commands.h"
#include "files/convert_weights.h"
#include "files/load.h"
#include "files/movable_model.h"
#include "flbc/errors.h"
#include "system/held_signals.h"

namespace flbc::app {
namespace {

struct ConvertArguments {
  WeightConversion files;
  bool quiet = false;
};

void check_weight_arguments(const WeightConversion& files) {
  if (io::holds(files.output, kMeshFiles))
    throw OptionError(files.output + ": weights cannot be written as a mesh; choose from " +
                      io::extensions_of({io::Content::kWeights}));
  require_writable(files.output, {io::Content::kWeights});
}

void check_mesh_arguments(const WeightConversion& files) {
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

// Reports what the new format loses.
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
      app.add_subcommand("convert", "convert weights, a mesh, or a model to another format");
  command->footer(
      "Weights: .mtx, .dmat, .npy, .csv. Conversions between them are lossless. Also .lbw,\n"
      "for graphics cards: single precision, at most 8 influences per vertex (flbc sparsify -k "
      "8).\n"
      "Models: .obj, .off, .ply, .stl, .om, .glb; .gltf is only read. Meshes: 2D .obj, .off,\n"
      ".vtu; 3D .mesh, .msh, .vtu. The program reports attributes that the new "
      "format\n"
      "does not support. A .ply or .stl result is a text file if the input is.");
  command->add_option("IN", a.input, "file to convert")->required();
  command->add_option("-o,--output", a.output, "converted file, of the same kind as IN")
      ->required();
  command->add_option("--cage", a.cage,
                      "cage of the weights, to check the number of control points");
  command->add_option("--points", a.points,
                      "model or mesh of the weights, to check the number of vertices");
  command->add_flag("--transpose", a.transpose, "read control points as rows");
  command->add_flag("-q,--quiet", arguments->quiet, "print only errors");
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
