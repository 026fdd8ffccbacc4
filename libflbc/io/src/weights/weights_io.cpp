// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/weights_io.h"

#include <cmath>
#include <new>
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

void check_finite(const WeightMatrix& weights) {
  for (Eigen::Index v = 0; v < weights.cols(); ++v) {
    if (weights.col(v).allFinite()) continue;
    Eigen::Index i = 0;
    while (std::isfinite(weights(i, v))) ++i;
    refuse_not_finite(i, v);
  }
}

void check_finite(const SparseWeights& weights) {
  for (Index p = 0; p < weights.num_points(); ++p) {
    weights.visit(p, [&](Index i, double weight) {
      if (!std::isfinite(weight)) refuse_not_finite(i, p);
    });
  }
}

WeightMatrix read_weights(const std::string& path) {
  const auto& format = format_of(path, Content::kWeights, "read weights as").weights;
  if (!format.read_sparse) return format.read(path, read_file(path));
  const auto weights = format.read_sparse(path, read_file(path));
  try {
    return weights.dense();
  } catch (const std::bad_alloc&) {
    throw InputError(path + ": " + std::to_string(weights.num_points()) + " x " +
                     std::to_string(weights.num_control_points()) +
                     " elements are declared, more than the memory can hold");
  }
}

SparseWeights read_sparse_weights(const std::string& path) {
  const auto& format = format_of(path, Content::kWeights, "read weights as").weights;
  return format.read_sparse ? format.read_sparse(path, read_file(path))
                            : SparseWeights(format.read(path, read_file(path)));
}

void write_weights(const std::string& path, const WeightMatrix& weights) {
  const auto& format = format_of(path, Content::kWeights, "write weights as").weights;
  check_finite(weights);
  write_file(path, [&](std::ostream& out) {
    format.write_sparse ? format.write_sparse(out, SparseWeights(weights))
                        : format.write(out, weights);
  });
}

void write_weights(const std::string& path, const SparseWeights& weights) {
  const auto& format = format_of(path, Content::kWeights, "write weights as").weights;
  check_finite(weights);
  write_file(path, [&](std::ostream& out) {
    format.write_sparse ? format.write_sparse(out, weights) : format.write(out, weights.dense());
  });
}

}  // namespace flbc::io
