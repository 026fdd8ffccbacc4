// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/weights_triplets.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ostream>
#include <vector>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "text/text_reader.h"
#include "text/text_writer.h"
#include "weights/weights_formats.h"

namespace flbc::io {
namespace {

// Otherwise a file for fewer control points or points would be read with zero weights.
void check_size(const std::string& path, const char* things, Index largest, Index count) {
  if (largest == count - 1) return;
  throw InputError(path + ": has weights for " + std::to_string(largest + 1) + " " + things +
                   ", but there are " + std::to_string(count));
}

TextReader open(const std::string& path) {
  TextReader::Syntax syntax;
  syntax.comment = '#';
  return TextReader(path, read_file(path), syntax);
}

struct TripletSize {
  Index controls = 0;
  Index points = 0;
};

// The size from the largest indices. A damaged index must not exhaust memory.
TripletSize size_by_numbers(const std::string& path) {
  constexpr Index kMost = std::numeric_limits<Index>::max() - 1;
  TextReader reader = open(path);
  TripletSize size;
  Index num_triplets = 0;
  for (; reader.next_line(); ++num_triplets) {
    size.controls = std::max(size.controls, reader.index("control points", 0, kMost) + 1);
    size.points = std::max(size.points, reader.index("points", 0, kMost) + 1);
  }
  if (num_triplets == 0) throw InputError(path + ": has no weights");
  const std::int64_t elements = std::int64_t{size.points} * size.controls;
  if (elements > kHarmlessElements && num_triplets < std::max(size.points, size.controls)) {
    throw InputError(path + ": the largest indices imply " + std::to_string(size.controls) +
                     " control points and " + std::to_string(size.points) +
                     " points, but there are only " + std::to_string(num_triplets) + " weights");
  }
  return size;
}

}  // namespace

SparseWeights read_weight_triplets(const std::string& path, Index num_controls, Index num_points) {
  TextReader reader = open(path);
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

SparseWeights read_weight_triplets(const std::string& path) {
  const TripletSize size = size_by_numbers(path);
  return read_weight_triplets(path, size.controls, size.points);
}

void write_weight_triplets(const std::string& path, const SparseWeights& weights) {
  if (weights.num_points() == 0 || weights.num_control_points() == 0)
    throw InputError("cannot write \"" + path + "\": there are no weights");
  check_finite(weights);
  write_file(path, [&](std::ostream& out) {
    TextWriter writer(out);
    writer << "# CONTROL_POINT POINT WEIGHT\n";
    const Index last_point = weights.num_points() - 1;
    const Index last_control_point = weights.num_control_points() - 1;
    const auto write = [&](Index i, Index p, double weight) {
      writer << i << " " << p << " " << weight << "\n";
    };
    for (Index p = 0; p <= last_point; ++p) {
      weights.visit(p, [&](Index i, double weight) { write(i, p, weight); });
    }
    if (weights.at(last_point)[last_control_point] == 0) write(last_control_point, last_point, 0);
    writer.flush();
  });
}

}  // namespace flbc::io
