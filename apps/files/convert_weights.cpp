// SPDX-License-Identifier: BSD-3-Clause
#include "files/convert_weights.h"

#include <iostream>

#include "files/load.h"
#include "files/movable_model.h"
#include "flbc/errors.h"
#include "flbc/io/weights_io.h"
#include "solve/weights_of_model.h"
#include "system/held_signals.h"

namespace flbc::app {
namespace {

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
  auto weights = io::read_weights(input);
  if (conversion.transpose) weights = WeightMatrix(weights.dense().transpose());
  check_files(weights, conversion);
  return weights;
}

}  // namespace

bool is_weight_file(const std::string& path) {
  return io::holds(path, {io::Content::kWeights});
}

void convert_weights(const WeightConversion& conversion, bool quiet) {
  const auto weights = load(conversion);
  naming(conversion.input, [&] {
    const HeldSignals held;
    io::write_weights(conversion.output, weights);
  });
  if (quiet) return;
  std::cerr << conversion.output << ": weights of " << weights.num_points() << " points for "
            << weights.num_control_points() << " control points\n";
}

}  // namespace flbc::app
