// SPDX-License-Identifier: BSD-3-Clause
// Blocks of numbers shared by several weight formats.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/messages.h"
#include "flbc/errors.h"
#include "text/bytes.h"
#include "text/text_reader.h"
#include "weights/weights_formats.h"

namespace flbc::io {

bool is_absurd(std::int64_t num_points, std::int64_t num_controls) {
  return std::min(num_points, num_controls) == 0 &&
         std::max(num_points, num_controls) > kHarmlessElements;
}

WeightMatrix read_columns(TextReader& reader, Index num_points, Index num_controls) {
  const std::int64_t elements = std::int64_t{num_points} * num_controls;
  if (is_absurd(num_points, num_controls)) {
    reader.fail(std::to_string(num_points) + " rows and " + std::to_string(num_controls) +
                " columns are declared, which is not a weight matrix");
  }
  if (static_cast<std::size_t>(elements) > (reader.bytes_left() + 1) / 2) {
    reader.fail(std::to_string(num_points) + " rows and " + std::to_string(num_controls) +
                " columns are declared, but the file is too short to hold them");
  }
  WeightMatrix weights(num_controls, num_points);
  for (Index i = 0; i < num_controls; ++i) {
    for (Index v = 0; v < num_points; ++v) {
      reader.next_word_of("numbers", std::int64_t{i} * num_points + v, elements);
      weights(i, v) = reader.number();
    }
  }
  reader.expect_end_of_file("the last declared number");
  return weights;
}

void BinaryBlock::fail(std::size_t byte, const std::string& message) const {
  throw InputError(path + ": at byte " + std::to_string(byte) + ": " + message);
}

void BinaryBlock::check_size(std::int64_t num_points, std::int64_t num_controls,
                             std::size_t bytes_each) const {
  const std::string declared = std::to_string(num_points) + " points x " +
                               std::to_string(num_controls) + " control points are declared";
  constexpr std::int64_t kMaxIndex = std::numeric_limits<Index>::max();
  if (num_points < 0 || num_controls < 0) fail(0, declared + "; numbers cannot be negative");
  if (is_absurd(num_points, num_controls))
    fail(offset, declared + ", which is not a weight matrix");
  if (num_points > kMaxIndex || num_controls > kMaxIndex) {
    fail(0, declared + ", more than this program can handle");
  }
  // The product of two 31-bit numbers fits, its number of bytes may not.
  const auto count = static_cast<std::size_t>(num_points * num_controls);
  const std::size_t bytes = content.size() - offset;
  if (count > bytes / bytes_each) {
    fail(content.size(), declared + ", but the file ends after " +
                             std::to_string(bytes / bytes_each) + " of " + std::to_string(count) +
                             " numbers");
  }
  if (count * bytes_each < bytes) {
    fail(offset + count * bytes_each, declared + ", but the file has " +
                                          std::to_string(bytes - count * bytes_each) +
                                          " more bytes after the last number");
  }
}

template <class Scalar>
WeightMatrix BinaryBlock::read(std::int64_t num_points, std::int64_t num_controls,
                               bool by_point) const {
  check_size(num_points, num_controls, sizeof(Scalar));
  WeightMatrix weights(num_controls, num_points);
  const char* next = content.data() + offset;
  const std::int64_t outer = by_point ? num_points : num_controls;
  const std::int64_t inner = by_point ? num_controls : num_points;
  for (std::int64_t i = 0; i < outer; ++i) {
    for (std::int64_t k = 0; k < inner; ++k, next += sizeof(Scalar)) {
      const auto value = number_at<Scalar>(next);
      const std::int64_t point = by_point ? i : k;
      const std::int64_t control = by_point ? k : i;
      if (!std::isfinite(value)) {
        fail(static_cast<std::size_t>(next - content.data()),
             "the weight of control point " + std::to_string(control) + " at point " +
                 std::to_string(point) +
                 " is not finite: " + format_number(static_cast<double>(value)));
      }
      weights(control, point) = static_cast<double>(value);
    }
  }
  return weights;
}

template WeightMatrix BinaryBlock::read<float>(std::int64_t, std::int64_t, bool) const;
template WeightMatrix BinaryBlock::read<double>(std::int64_t, std::int64_t, bool) const;

}  // namespace flbc::io
