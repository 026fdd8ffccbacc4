// SPDX-License-Identifier: BSD-3-Clause
#include "files/convert_weights.h"

#include <iostream>

#include "files/held_signals.h"
#include "files/load.h"
#include "files/movable_model.h"
#include "flbc/errors.h"
#include "flbc/io/weights_io.h"
#include "flbc/io/weights_triplets.h"
#include "solve/weights_of_model.h"

namespace flbc::app {
namespace {

bool holds_triplets(const std::string& path) {
  return io::holds(path, {io::Content::kTriplets});
}

void check_files(const WeightMatrix& weights, const WeightConversion& conversion) {
  const auto& [input, output, cage, points, transpose] = conversion;
  const Eigen::Index num_controls = cage.empty() ? weights.rows() : count_vertices(cage);
  const Eigen::Index num_points = points.empty() ? weights.cols() : count_vertices(points);
  const bool is_turned = num_controls == weights.cols() && num_points == weights.rows();
  if (is_turned && num_controls != num_points) {
    throw InputError(input + (transpose ? ": has points as rows; leave out --transpose"
                                        : ": has control points as rows; give --transpose"));
  }
  check_sizes(weights, num_controls, num_points, {input, cage, points});
}

WeightMatrix load(const WeightConversion& conversion) {
  const auto& input = conversion.input;
  auto weights = read_weight_file(input);
  if (conversion.transpose) weights.transposeInPlace();
  check_files(weights, conversion);
  return weights;
}

void save(const std::string& path, const WeightMatrix& weights) {
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

WeightMatrix read_weight_file(const std::string& path) {
  return holds_triplets(path) ? io::read_weight_triplets(path) : io::read_weights(path);
}

void convert_weights(const WeightConversion& conversion, bool quiet) {
  const auto& [input, output, cage, points, transpose] = conversion;
  const auto weights = load(conversion);
  naming(input, [&] { save(conversion.output, weights); });
  if (quiet) return;
  std::cerr << output << ": weights of " << weights.cols() << " points for " << weights.rows()
            << " control points\n";
  if (holds_triplets(input) && (cage.empty() || points.empty())) {
    std::cerr << "flbc: " << input
              << " does not contain these numbers; they are the largest indices "
              << "in it plus 1. Check them with --cage and --points\n";
  }
}

}  // namespace flbc::app
