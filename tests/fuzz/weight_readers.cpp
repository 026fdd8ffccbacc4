// SPDX-License-Identifier: BSD-3-Clause
// Weights.
#include <algorithm>
#include <cmath>
#include <string>

#include "flbc/io/weights_io.h"
#include "fuzz/reader.h"

namespace flbc::fuzz {
namespace {

// Matrices that are larger take time to write that is better spent on reading.
constexpr Index kSmall = 256;

bool are_finite(const SparseWeights& weights) {
  const auto& values = weights.values();
  return std::all_of(values.begin(), values.end(), [](double w) { return std::isfinite(w); });
}

void read_weights(const std::string& path) {
  const auto weights = io::read_weights(path);
  require(are_finite(weights), "weights are finite");
  if (std::max(weights.num_control_points(), weights.num_points()) > kSmall) return;
  io::write_weights(path, weights);
  require(io::read_weights(path) == weights, "what is written is read back");
}

std::string file_of_weights(const std::string& name) {
  WeightMatrix weights(2, 3);
  weights << 1, 0, 1.0 / 3, 0, 1, 2.0 / 3;
  return written(name, [&](const std::string& path) { io::write_weights(path, weights); });
}

}  // namespace

std::vector<Reader> weight_readers() {
  return {
      {"mtx", "input.mtx", read_weights, {file_of_weights("a.mtx")}},
      {"npy",
       "input.npy",
       read_weights,
       {file_of_weights("a.npy"),
        npy("{'descr': '<f4', 'fortran_order': True, 'shape': (3L, 2), }", std::string(24, '\0'))}},
      {"csv", "input.csv", read_weights, {file_of_weights("a.csv")}}};
}

}  // namespace flbc::fuzz
