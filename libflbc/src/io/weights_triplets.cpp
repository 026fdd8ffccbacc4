// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/weights_triplets.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "text_reader.h"

namespace flbc::io {
namespace {

// A file for fewer control points or points would otherwise pass for weights that are 0.
void check_size(const std::string& path, const char* things, Index largest, Index count) {
  if (largest == count - 1) return;
  throw InputError(path + ": has weights for " + std::to_string(largest + 1) + " " + things +
                   ", but " + std::to_string(count) + " are there");
}

}  // namespace

WeightMatrix read_weight_triplets(const std::string& path, Index num_controls, Index num_points) {
  TextReader::Syntax syntax;
  syntax.comment = '#';
  TextReader reader(path, read_file(path), syntax);
  WeightMatrix weights = WeightMatrix::Zero(num_controls, num_points);
  std::vector<bool> seen(static_cast<std::size_t>(weights.size()), false);
  Index last_control = -1, last_point = -1;
  while (reader.next_line()) {
    const Index control = reader.index("control points", 0, num_controls);
    const Index point = reader.index("points", 0, num_points);
    weights(control, point) = reader.number();
    reader.expect_end_of_line();
    auto entry = seen[static_cast<std::size_t>(point) * static_cast<std::size_t>(num_controls) +
                      static_cast<std::size_t>(control)];
    if (entry) {
      reader.fail("the weight of control point " + std::to_string(control) + " at point " +
                  std::to_string(point) + " occurs twice");
    }
    entry = true;
    last_control = std::max(last_control, control);
    last_point = std::max(last_point, point);
  }
  check_size(path, "control points", last_control, num_controls);
  check_size(path, "points", last_point, num_points);
  return weights;
}

}  // namespace flbc::io
