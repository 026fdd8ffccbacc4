// SPDX-License-Identifier: BSD-3-Clause
// MATLAB files of level 5, not compressed, with one matrix of doubles: a header of 128 bytes, then
// an element for the matrix with elements for its flags, dimensions, name, and numbers. An element
// is a type, a number of bytes, and the bytes, padded to a multiple of 8. Type and size of short
// elements share four bytes.
#include <array>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <ostream>

#include "flbc/errors.h"
#include "text/bytes.h"
#include "weights/weights_formats.h"

namespace flbc::io {
namespace {

constexpr std::size_t kHeader = 128, kTag = 8;
constexpr std::uint32_t kInt8 = 1, kInt32 = 5, kUint32 = 6, kDouble = 9, kMatrix = 14,
                        kCompressed = 15;
constexpr std::uint32_t kClassOfDoubles = 6;
constexpr const char* kHint = "; save one matrix of doubles with -v6";

struct Element {
  std::uint32_t type, size;
  std::size_t begin, end;  // of its bytes, and of the padding after them
};

class MatReader {
 public:
  MatReader(const std::string& path, const std::string& content)
      : content_(content), block_{path, content, 0} {}

  WeightMatrix read() {
    if (content_.size() < kHeader + kTag || content_.compare(126, 2, "IM") != 0) {
      block_.fail(0, std::string("not a MATLAB file of level 5") + kHint);
    }
    position_ = kHeader;
    const auto matrix = next();
    if (matrix.type == kCompressed) refuse("the matrix is compressed");
    if (matrix.type != kMatrix) refuse("expected a matrix");
    position_ = matrix.begin;
    const auto flags = expect(kUint32, "flags");
    constexpr std::uint32_t kComplex = 0x800, kClass = 0xff;
    const auto word = number<std::uint32_t>(flags, 0);
    if ((word & kClass) != kClassOfDoubles || (word & kComplex) != 0) {
      refuse("the matrix is not one of doubles");
    }
    const auto dimensions = expect(kInt32, "dimensions");
    if (dimensions.size != 2 * sizeof(std::int32_t)) refuse("the array has not two dimensions");
    const auto rows = number<std::int32_t>(dimensions, 0);
    const auto columns = number<std::int32_t>(dimensions, 1);
    expect(kInt8, "a name");
    const auto numbers = next();
    if (numbers.type != kDouble) refuse("the numbers are not stored as doubles");
    return BinaryBlock{block_.path, content_, numbers.begin}.read<double>(rows, columns, false);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { block_.fail(position_, what + kHint); }

  template <class T>
  T number(const Element& element, std::size_t k) const {
    if ((k + 1) * sizeof(T) > element.size) refuse("an element is too short");
    return number_at<T>(content_.data() + element.begin + k * sizeof(T));
  }

  Element next() {
    if (content_.size() < position_ + kTag) refuse("the file ends within the matrix");
    const auto tag = number_at<std::array<std::uint32_t, 2>>(content_.data() + position_);
    constexpr std::uint32_t kShortSize = 16;  // bits
    Element element{tag[0], tag[1], position_ + kTag, 0};
    if (tag[0] >> kShortSize != 0) {
      element = {tag[0] & 0xffff, tag[0] >> kShortSize, position_ + kTag / 2, position_ + kTag};
      if (element.size > kTag / 2) refuse("an element is damaged");
    } else {
      element.end = element.begin + (std::size_t{element.size} + 7) / 8 * 8;
    }
    position_ = element.end;
    return element;
  }

  Element expect(std::uint32_t type, const char* what) {
    const auto element = next();
    if (element.type != type || content_.size() < element.end) {
      refuse(std::string("expected ") + what);
    }
    return element;
  }

  const std::string& content_;
  const BinaryBlock block_;
  std::size_t position_ = 0;
};

template <class T>
void append(std::string& bytes, std::initializer_list<T> values) {
  for (const T value : values) bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

// Signature required by the format table. NOLINTNEXTLINE(performance-unnecessary-value-param)
WeightMatrix read_mat(const std::string& path, std::string content) {
  return MatReader(path, content).read();
}

void write_mat(std::ostream& out, const WeightMatrix& weights) {
  const std::string name = "weights";
  const auto size = static_cast<std::uint64_t>(weights.size()) * sizeof(double);
  std::string header = "MATLAB 5.0 MAT-file, weights: a row per point, a column per control point";
  header.resize(124, ' ');
  append<std::uint16_t>(header, {0x0100});
  header += "IM";
  std::string head;
  append<std::uint32_t>(head, {kUint32, 8, kClassOfDoubles, 0, kInt32, 8});
  append<std::int32_t>(
      head, {static_cast<std::int32_t>(weights.cols()), static_cast<std::int32_t>(weights.rows())});
  append<std::uint32_t>(head, {kInt8, static_cast<std::uint32_t>(name.size())});
  head += name + '\0';
  if (size + head.size() + kTag > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError("the weights are too large for .mat, which holds 4 GB; choose .npy");
  }
  append<std::uint32_t>(head, {kDouble, static_cast<std::uint32_t>(size)});
  append<std::uint32_t>(header, {kMatrix, static_cast<std::uint32_t>(head.size() + size)});
  out << header << head;
  write_columns(out, weights);
}

}  // namespace flbc::io
