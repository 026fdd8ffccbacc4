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
  const auto& [input, output, cage, points, threshold, transpose] = conversion;
  const Eigen::Index num_controls = cage.empty() ? weights.rows() : count_vertices(cage);
  const Eigen::Index num_points = points.empty() ? weights.cols() : count_vertices(points);
  const bool is_turned = num_controls == weights.cols() && num_points == weights.rows();
  if (is_turned && num_controls != num_points) {
    throw InputError(input + (transpose ? ": has points as rows; leave --transpose out"
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

// Changes due to dropped weights.
struct Dropped {
  Eigen::Index count = 0;
  double largest_sum = 0;  // of one point
};

Dropped drop(WeightMatrix& weights, double threshold) {
  Dropped dropped;
  for (auto column : weights.colwise()) {
    double sum = 0;
    for (double& weight : column) {
      if (weight == 0 || std::abs(weight) > threshold) continue;
      sum += weight;
      weight = 0;
      ++dropped.count;
    }
    dropped.largest_sum = std::max(dropped.largest_sum, std::abs(sum));
  }
  return dropped;
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
  const auto& [input, output, cage, points, threshold, transpose] = conversion;
  auto weights = load(conversion);
  Dropped dropped;
  if (threshold) dropped = drop(weights, *threshold);
  naming(input, [&] { save(conversion.output, weights); });
  if (quiet) return;
  std::cerr << output << ": weights of " << weights.cols() << " points for " << weights.rows()
            << " control points\n";
  if (holds_triplets(input) && (cage.empty() || points.empty())) {
    std::cerr << "flbc: " << input << " does not tell these numbers; they are the largest ones in "
              << "it (--cage and --points check them)\n";
  }
  if (threshold) {
    std::cerr << "flbc: " << dropped.count << " weights up to " << *threshold
              << " were dropped, which changes the sum of a point's weights by at most "
              << dropped.largest_sum << '\n';
  }
}

}  // namespace flbc::app
