// SPDX-License-Identifier: BSD-3-Clause
// flbc compose: weights for the control points that move a cage.
#include <iostream>
#include <memory>

#include "commands/commands.h"
#include "flbc/deform.h"
#include "flbc/io/binding_file.h"
#include "flbc/io/weights_io.h"
#include "flbc/quality.h"
#include "front/bound_model.h"
#include "front/load.h"
#include "front/poses.h"

namespace flbc::app {
namespace {

struct ComposeArguments {
  BindingFiles files;  // weights
  std::string map, cage, output;
  bool quiet = false;
};

void compose_files(const ComposeArguments& arguments) {
  require_writable(arguments.output, {io::Content::kWeights});
  require_distinct({arguments.files.weights, arguments.map, arguments.cage}, {arguments.output});
  const auto map = io::read_weights(arguments.map);
  const auto compose_binding = [&](const auto& binding) {
    constexpr int kDim = std::decay_t<decltype(binding.cage.points)>::RowsAtCompileTime;
    const auto outer = RestCage<kDim>(arguments.cage).cage();
    const auto composed = naming(arguments.map, [&] { return binding.composed(map, outer); });
    write_binding(arguments.output, composed);
    return composed.weights;
  };
  SparseWeights composed;
  if (io::is_binding_file(arguments.output)) {
    if (arguments.cage.empty()) {
      throw OptionError("--cage is missing, the outer cage of the binding");
    }
    composed = std::visit(compose_binding, arguments.files.content());
  } else {
    const auto weights = io::read_weights(arguments.files.weights);
    composed = naming(arguments.map, [&] { return compose(weights, map); });
    io::write_weights(arguments.output, composed);
  }
  if (arguments.quiet) return;
  std::cerr << arguments.output << ": " << composed.num_points() << " vertices, "
            << composed.num_control_points() << " control points, at most "
            << count_influences(composed).max << " influences per vertex\n";
}

}  // namespace

void add_compose_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<ComposeArguments>();
  auto& a = *arguments;
  auto* command = app.add_subcommand("compose", "compute weights for the cage of a cage");
  command->footer(
      "If the control points of WEIGHTS follow others by the weights in MAP, the product of both\n"
      "moves the model by those others. Limit its influences by flbc sparsify.");
  command->add_option("WEIGHTS", a.files.weights, std::string("weights: ") + kWeightFormats)
      ->required();
  command
      ->add_option("MAP", a.map,
                   "weights of the control points of WEIGHTS: a row for each, at least 0, sum 1")
      ->required();
  command->add_option("--cage", a.cage,
                      "the outer cage at rest, if the result is a binding (.npz)");
  command->add_option("-o,--output", a.output, std::string("new weights: ") + kWeightFormats)
      ->required();
  command->add_flag("-q,--quiet", a.quiet, "print only errors");
  command->callback([arguments] { compose_files(*arguments); });
}

}  // namespace flbc::app
