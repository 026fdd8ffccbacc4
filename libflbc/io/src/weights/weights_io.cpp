// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/weights_io.h"

#include <cmath>
#include <ostream>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "formats/format_table.h"

namespace flbc::io {

void check_finite(const WeightMatrix& weights) {
  for (Eigen::Index v = 0; v < weights.cols(); ++v) {
    if (weights.col(v).allFinite()) continue;
    Eigen::Index i = 0;
    while (std::isfinite(weights(i, v))) ++i;
    throw InputError("the weight of control point " + std::to_string(i) + " at point " +
                     std::to_string(v) + " is not finite");
  }
}

WeightMatrix read_weights(const std::string& path) {
  const auto& format = format_of(path, Content::kWeights, "read weights as");
  return format.weights.read(path, read_file(path));
}

void write_weights(const std::string& path, const WeightMatrix& weights) {
  const auto& format = format_of(path, Content::kWeights, "write weights as");
  check_finite(weights);
  write_file(path, [&](std::ostream& out) { format.weights.write(out, weights); });
}

}  // namespace flbc::io
