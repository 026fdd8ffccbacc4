// SPDX-License-Identifier: BSD-3-Clause
// flbc transfer: weights for another version of a model.
#include <iostream>
#include <memory>
#include <sstream>

#include "commands/commands.h"
#include "files/load.h"
#include "files/locality_file.h"
#include "files/model_facets.h"
#include "flbc/bounding_box.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/weights_io.h"
#include "flbc/quality.h"
#include "solve/cage_solver.h"
#include "solve/weights_of_model.h"
#include "system/held_signals.h"

namespace flbc::app {
namespace {

struct TransferArguments {
  std::string weights;
  std::string cage;
  std::string from;
  std::string domain;
  std::string to;
  std::string output;
  double limit = 0.02;  // of the size of the model
  OutsidePoints outside = OutsidePoints::kFail;
  std::string locality;
  bool quiet = false;
};

void check_arguments(const TransferArguments& arguments) {
  if (arguments.from.empty() == arguments.domain.empty()) {
    throw OptionError("give --from (a model that has these weights) or --domain (a mesh)");
  }
  require_writable(arguments.output, {io::Content::kWeights});
  require_distinct({arguments.weights, arguments.cage, arguments.from, arguments.domain,
                    arguments.to, arguments.locality},
                   {arguments.output});
}

// New weights, and how they came about.
template <int Dim>
struct Transferred {
  SparseWeights weights;
  PointList<Dim> points;  // where they put the vertices
  std::string facts;
};

template <int Dim>
Transferred<Dim> from_domain(const Cage<Dim>& cage, const SparseWeights& weights,
                             const TransferArguments& arguments) {
  const auto domain = io::read_domain<Dim>(arguments.domain);
  check_reproduction(weights, cage, domain.points,
                     {arguments.weights, arguments.cage, arguments.domain});
  const auto to = load_model<Dim>(arguments.to);
  const auto placement =
      placing<Dim>(arguments.to, [&] { return place_points(cage, domain, to, arguments.outside); });
  if (!arguments.quiet) warn_outside(placement, cage, arguments.to);
  auto transferred = weights_at(cage, domain, weights, placement);
  if (!arguments.locality.empty()) {
    const auto masks = load_locality(arguments.locality, cage, to, arguments.to).masks;
    transferred = naming(arguments.locality, [&] {
      return enforce_masks(cage, placement, transferred,
                           place_masks(cage, domain, placement, masks));
    });
  }
  return {std::move(transferred), placement.points, describe(placement, cage)};
}

template <int Dim>
Transferred<Dim> from_model(const Cage<Dim>& cage, const SparseWeights& weights,
                            const TransferArguments& arguments) {
  const auto from = load_model_elements<Dim>(arguments.from);
  check_reproduction(weights, cage, from.points,
                     {arguments.weights, arguments.cage, arguments.from});
  auto to = load_model<Dim>(arguments.to);
  const double size = bounding_box_diagonal(from.points);
  Eigen::VectorXd distances;
  auto transferred = naming(arguments.to, [&] {
    const auto locality = load_locality(arguments.locality, cage, to, arguments.to);
    const PointMasks masks(end_at_facets(cage, to, locality.masks), cage.size(),
                           static_cast<Index>(to.cols()));
    return transfer_weights(cage.points, from, weights, to, arguments.limit * size, &distances,
                            masks);
  });
  std::ostringstream facts;
  facts << "; at most " << 100 * distances.maxCoeff() / size << "% of the size away from "
        << arguments.from;
  return {std::move(transferred), std::move(to), facts.str()};
}

template <int Dim>
void transfer(const Cage<Dim>& cage, const TransferArguments& arguments) {
  const auto weights = io::read_weights(arguments.weights);
  const auto result = arguments.domain.empty() ? from_model(cage, weights, arguments)
                                               : from_domain(cage, weights, arguments);
  {
    const HeldSignals held;
    io::write_weights(arguments.output, result.weights);
  }
  if (arguments.quiet) return;
  const auto quality = measure_quality(cage.points, result.points, result.weights);
  std::cerr << arguments.output << ": " << result.weights.num_points()
            << " vertices; minimum weight " << quality.min_weight << ", reproduction error "
            << quality.max_reproduction_error << result.facts << '\n';
}

}  // namespace

void add_transfer_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<TransferArguments>();
  auto& a = *arguments;
  auto* command = app.add_subcommand("transfer", "transfer weights to another version of a model");
  command->footer(
      "With --domain, WEIGHTS belong to the domain mesh (domain_weights.npy of flbc run), and the\n"
      "result is what flbc solve computes for the model. With --from, WEIGHTS belong to another\n"
      "model. Each vertex gets the weights of the nearest point on that model, with the smallest\n"
      "change that makes them >= 0 and reproduces the vertex.");
  command->add_option("WEIGHTS", a.weights, std::string("existing weights: ") + kWeightFormats)
      ->required();
  command->add_option("--cage", a.cage, "cage of the weights")->required();
  auto* from = command->add_option("--from", a.from, "model that has these weights");
  auto* domain = command->add_option("--domain", a.domain, "domain mesh that has these weights");
  domain->excludes(from);
  command->add_option("--to", a.to, "model that needs weights")->required();
  command
      ->add_option("--limit", a.limit,
                   "maximum distance between the models, relative to their size (default: 0.02)")
      ->check(in_range(0, 1))
      ->needs(from);
  add_choice(*command, "--outside", a.outside,
             "method for vertices outside the cage, as in flbc solve (default: fail)")
      ->needs(domain);
  add_locality_option(*command, a.locality);
  command->add_option("-o,--output", a.output, std::string("new weights: ") + kWeightFormats)
      ->required();
  command->add_flag("-q,--quiet", a.quiet, "print only errors");
  command->callback([arguments] {
    check_arguments(*arguments);
    std::visit([&](const auto& cage) { transfer(cage, *arguments); }, load_cage(arguments->cage));
  });
}

}  // namespace flbc::app
