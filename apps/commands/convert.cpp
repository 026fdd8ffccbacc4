// SPDX-License-Identifier: BSD-3-Clause
// flbc convert: weights or meshes from one format to another.
#include <iostream>
#include <memory>

#include "commands/commands.h"
#include "flbc/errors.h"
#include "flbc/io/weights_io.h"
#include "front/gltf_facts.h"
#include "front/load.h"
#include "front/movable_model.h"
#include "front/system/held_signals.h"
#include "model/gltf_edit.h"

namespace flbc::app {
namespace {

struct ConvertArguments {
  std::string input;
  std::string output;
  bool transpose = false;   // the input has control points as rows
  bool is_unposed = false;  // the input loses its skins
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
  if (files.transpose) {
    throw OptionError("--transpose is for weights, but " + files.input + " is a mesh");
  }
}

void check_arguments(const ConvertArguments& files) {
  if (files.is_unposed && !is_gltf_file(files.input)) {
    throw OptionError("--bind-pose is for .glb, .gltf, and .vrm, not for " + files.input);
  }
  if (files.is_unposed && io::extension_of(files.output) != "glb") {
    throw OptionError("--bind-pose writes .glb, not " + files.output +
                      "; convert the .glb file in a second step");
  }
  if (is_weight_file(files.input)) {
    check_weight_arguments(files);
  } else {
    check_mesh_arguments(files);
  }
  require_distinct({files.input}, {files.output});
}

void convert_weights(const ConvertArguments& files) {
  auto weights = io::read_weights(files.input);
  if (files.transpose) weights = WeightMatrix(weights.dense().transpose());
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

void convert_to_bind_pose(const ConvertArguments& files) {
  std::vector<std::string> left_out;
  write_text(files.output, io::unposed_gltf(files.input, left_out));
  if (!files.quiet) std::cerr << files.output << ": " << files.input << " as it was bound\n";
  warn_left_out(files.output, files.input, left_out);
}

}  // namespace

void add_convert_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<ConvertArguments>();
  auto& a = *arguments;
  auto* command =
      app.add_subcommand("convert", "convert weights, a mesh, or a model to another format");
  command->footer(
      "Weights: .mtx, .npy, .csv. Conversions between them are lossless.\n"
      "Models: .obj, .off, .ply, .stl, .glb; .gltf is only read.\n"
      "Meshes: 2D .obj, .off; 3D .mesh, .msh; .vtu is only written.\n"
      "The program reports attributes that the new format does not support. A .ply or .stl\n"
      "result is a text file if the input is.");
  command->add_option("IN", a.input, "file to convert")->required();
  command->add_option("-o,--output", a.output, "converted file, of the same kind as IN")
      ->required();
  command->add_flag("--transpose", a.transpose, "read control points as rows");
  command->add_flag("--bind-pose", a.is_unposed,
                    "write a glTF model as its skins were bound, without these");
  command->add_flag("-q,--quiet", a.quiet, "print only errors");
  command->callback([arguments] {
    check_arguments(*arguments);
    const auto convert = arguments->is_unposed              ? convert_to_bind_pose
                         : is_weight_file(arguments->input) ? convert_weights
                                                            : convert_mesh;
    convert(*arguments);
  });
}

}  // namespace flbc::app
