// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/weights_io.h"

#include <cmath>
#include <ostream>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "formats/format_table.h"

namespace flbc::io {

namespace {

[[noreturn]] void refuse_not_finite(std::int64_t control_point, std::int64_t point) {
  throw InputError("the weight of control point " + std::to_string(control_point) + " at point " +
                   std::to_string(point) + " is not finite");
}

}  // namespace

void check_finite(const SparseWeights& weights) {
  for (Index p = 0; p < weights.num_points(); ++p) {
    weights.visit(p, [&](Index i, double weight) {
      if (!std::isfinite(weight)) refuse_not_finite(i, p);
    });
  }
}

SparseWeights read_weights(const std::string& path) {
  const auto& format = format_of(path, Content::kWeights, "read weights as").weights;
  if (!format.read) {
    throw OptionError(path + ": this format is only written; use the weights that it was made of");
  }
  return format.read(path, read_file(path));
}

void write_weights(const std::string& path, const SparseWeights& weights) {
  const auto& format = format_of(path, Content::kWeights, "write weights as").weights;
  check_finite(weights);
  write_file(path, [&](std::ostream& out) { format.write(out, weights); });
}

}  // namespace flbc::io
