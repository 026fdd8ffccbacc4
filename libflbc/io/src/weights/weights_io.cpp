// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/weights_io.h"

#include <cmath>
#include <ostream>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "weights/weights_formats.h"

namespace flbc::io {
namespace {

[[noreturn]] void fail_extension(const char* action, const std::string& path) {
  throw OptionError(std::string("cannot ") + action + " weights as \"" + path +
                    "\": the extension must be .mtx, .dmat or .npy");
}

// A reader would refuse them, so they are not written in the first place.
void check_finite(const WeightMatrix& weights) {
  for (Eigen::Index v = 0; v < weights.cols(); ++v) {
    if (weights.col(v).allFinite()) continue;
    Eigen::Index i = 0;
    while (std::isfinite(weights(i, v))) ++i;
    throw InputError("the weight of control point " + std::to_string(i) + " at point " +
                     std::to_string(v) + " is not finite");
  }
}

}  // namespace

WeightMatrix read_weights(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == "mtx") return read_mtx(path, read_file(path));
  if (extension == "dmat") return read_dmat(path, read_file(path));
  if (extension == "npy") return read_npy(path, read_file(path));
  fail_extension("read", path);
}

void write_weights(const std::string& path, const WeightMatrix& weights) {
  const std::string extension = extension_of(path);
  const auto write = extension == "mtx"    ? write_mtx
                     : extension == "dmat" ? write_dmat
                     : extension == "npy"  ? write_npy
                                           : nullptr;
  if (!write) fail_extension("write", path);
  check_finite(weights);
  write_file(path, [&](std::ostream& out) { write(out, weights); });
}

}  // namespace flbc::io
