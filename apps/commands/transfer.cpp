// SPDX-License-Identifier: BSD-3-Clause
// flbc transfer: weights for another version of a model.
#include <iostream>
#include <memory>
#include <sstream>

#include "commands/commands.h"
#include "flbc/bounding_box.h"
#include "flbc/io/weights_io.h"
#include "flbc/quality.h"
#include "front/bound_model.h"
#include "front/load.h"
#include "front/model_facets.h"
#include "front/movable_model.h"
#include "help/options.h"
#include "solve/cage_solver.h"

namespace flbc::app {
namespace {

struct TransferArguments {
  BindingFiles files;
  std::string from;
  std::string to;
  std::string output;
  double limit = 0.02;  // of the size of the model
  OutsidePoints outside = OutsidePoints::kFail;
  bool quiet = false;
};

void check_arguments(const TransferArguments& arguments) {
  require_cage(arguments.files);
  if (arguments.from.empty() && arguments.files.domain.empty() && !arguments.files.is_one()) {
    throw OptionError("--from (a model that has these weights) or --domain (a mesh) is missing");
  }
  require_writable(arguments.output, {io::Content::kWeights});
  require_distinct({arguments.files.weights, arguments.files.cage, arguments.files.domain,
                    arguments.from, arguments.to},
                   {arguments.output});
}

template <int Dim>
Binding<Dim> from_domain(const TransferArguments& arguments, const MovableModel<Dim>& to) {
  const auto binding = load_domain_binding<Dim>(arguments.files);
  return naming(arguments.to,
                [&] { return binding.transferred(to.points(), to.edges(), arguments.outside); });
}

template <int Dim>
Binding<Dim> from_model(const TransferArguments& arguments, const MovableModel<Dim>& to,
                        std::string& facts) {
  const auto from = load_model_elements<Dim>(arguments.from);
  const auto binding = load_binding<Dim>(arguments.files, arguments.from, from.points, {});
  const double size = bounding_box_diagonal(from.points);
  Eigen::VectorXd distances;
  auto result = naming(arguments.to, [&] {
    return binding.transferred(from.corners, to.points(), to.edges(), arguments.limit * size,
                               &distances);
  });
  std::ostringstream text;
  text << "; at most " << 100 * distances.maxCoeff() / size << "% of the size away from "
       << arguments.from;
  facts = text.str();
  return result;
}

template <int Dim>
void transfer(const TransferArguments& arguments) {
  const MovableModel<Dim> to({arguments.to, arguments.to});
  std::string facts;
  const auto result =
      arguments.from.empty() ? from_domain(arguments, to) : from_model(arguments, to, facts);
  if (!arguments.quiet) warn_outside(result, arguments.to);
  write_binding(arguments.output, result);
  if (arguments.quiet) return;
  const auto quality = measure_quality(result.cage.points, result.points, result.weights);
  std::cerr << arguments.output << ": " << result.weights.num_points()
            << " vertices; minimum weight " << quality.min_weight << ", reproduction error "
            << quality.max_reproduction_error << facts << '\n';
}

}  // namespace

void add_transfer_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<TransferArguments>();
  auto& a = *arguments;
  auto* command = app.add_subcommand("transfer", "transfer weights to another version of a model");
  command->footer(
      "A binding (.npz) is evaluated on its domain mesh, and the result is what flbc solve\n"
      "computes for the model. With --domain, WEIGHTS belong to this mesh (domain_weights.npy of\n"
      "flbc run). With --from, WEIGHTS belong to another model. Each vertex gets the weights of\n"
      "the nearest point on that model, with the smallest change that makes them >= 0 and\n"
      "reproduces the vertex.");
  command
      ->add_option("WEIGHTS", a.files.weights, std::string("existing weights: ") + kWeightFormats)
      ->required();
  add_cage_option(*command, a.files.cage);
  auto* from = command->add_option("--from", a.from, "model that has these weights");
  auto* domain =
      command->add_option("--domain", a.files.domain, "domain mesh that has these weights");
  domain->excludes(from);
  command->add_option("--to", a.to, "model that needs weights")->required();
  command
      ->add_option("--limit", a.limit,
                   "maximum distance between the models, relative to their size (default: 0.02)")
      ->check(in_range(0, 1))
      ->needs(from);
  add_choice(*command, "--outside", a.outside,
             "method for vertices outside the cage, as in flbc solve (default: fail)")
      ->excludes(from);
  command->add_option("-o,--output", a.output, std::string("new weights: ") + kWeightFormats)
      ->required();
  command->add_flag("-q,--quiet", a.quiet, "print only errors");
  command->callback([arguments] {
    check_arguments(*arguments);
    dimension_of(arguments->files) == 2 ? transfer<2>(*arguments) : transfer<3>(*arguments);
  });
}

}  // namespace flbc::app
