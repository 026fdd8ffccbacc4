// SPDX-License-Identifier: BSD-3-Clause
#include "files/convert_weights.h"

#include <iostream>

#include "files/load.h"
#include "files/movable_model.h"
#include "flbc/errors.h"
#include "flbc/io/weights_io.h"
#include "flbc/io/weights_triplets.h"
#include "solve/weights_of_model.h"
#include "system/held_signals.h"

namespace flbc::app {
namespace {

bool holds_triplets(const std::string& path) {
  return io::holds(path, {io::Content::kTriplets});
}

void check_files(const SparseWeights& weights, const WeightConversion& conversion) {
  const auto& [input, output, cage, points, transpose] = conversion;
  const Index given_controls = weights.num_control_points(), given_points = weights.num_points();
  const Index num_controls = cage.empty() ? given_controls : count_vertices(cage);
  const Index num_points = points.empty() ? given_points : count_vertices(points);
  const bool is_turned = num_controls == given_points && num_points == given_controls;
  if (is_turned && num_controls != num_points) {
    throw InputError(input + (transpose ? ": has points as rows; leave out --transpose"
                                        : ": has control points as rows; give --transpose"));
  }
  check_sizes(weights, num_controls, num_points, {input, cage, points});
}

SparseWeights load(const WeightConversion& conversion) {
  const auto& input = conversion.input;
  auto weights = read_weight_file(input);
  if (conversion.transpose) weights = WeightMatrix(weights.dense().transpose());
  check_files(weights, conversion);
  return weights;
}

void save(const std::string& path, const SparseWeights& weights) {
  const HeldSignals held;
  if (holds_triplets(path)) {
    io::write_weight_triplets(path, weights);
  } else {
    io::write_weights(path, weights);
  }
}

}  // namespace

bool is_weight_file(const std::string& path) {
  return io::holds(path, kWeightFiles);
}

SparseWeights read_weight_file(const std::string& path) {
  return holds_triplets(path) ? io::read_weight_triplets(path) : io::read_weights(path);
}

void convert_weights(const WeightConversion& conversion, bool quiet) {
  const auto& [input, output, cage, points, transpose] = conversion;
  const auto weights = load(conversion);
  naming(input, [&] { save(conversion.output, weights); });
  if (quiet) return;
  std::cerr << output << ": weights of " << weights.num_points() << " points for "
            << weights.num_control_points() << " control points\n";
  if (holds_triplets(input) && (cage.empty() || points.empty())) {
    std::cerr << "flbc: " << input
              << " does not contain these numbers; they are the largest indices "
              << "in it plus 1. Check them with --cage and --points\n";
  }
}

}  // namespace flbc::app
