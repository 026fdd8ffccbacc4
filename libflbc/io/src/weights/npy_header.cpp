// SPDX-License-Identifier: BSD-3-Clause
#include "weights/npy_header.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "base/messages.h"
#include "flbc/errors.h"
#include "text/bytes.h"
#include "text/text_reader.h"

namespace flbc::io {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";

// The header of a file, which is a Python dictionary.
class Header {
 public:
  Header(const std::string& path, std::string_view content) : path_(path), text_(content) {
    if (text_.substr(0, kMagic.size()) != kMagic) fail(0, "not a NumPy .npy file");
    const std::size_t version = byte(6);
    if (version < 1 || version > 3) {
      fail(6, "version " + std::to_string(version) + " of the format is not supported");
    }
    const std::size_t length_bytes = version == 1 ? 2 : 4;
    std::size_t size = 8 + length_bytes;
    for (std::size_t k = 0; k < length_bytes; ++k) size += byte(8 + k) << (8 * k);
    if (size > text_.size()) fail(text_.size(), "the file ends inside its header");
    text_ = text_.substr(0, size);
  }

  NpyHeader parse() const {
    NpyHeader header;
    header.size = text_.size();
    const auto type = value_of("descr");
    if (type + 1 >= text_.size() || (text_[type] != '\'' && text_[type] != '"')) {
      fail(type, "the array has structured elements; plain numbers expected");
    }
    const auto end = std::min(text_.find(text_[type], type + 1), text_.size());
    header.type = text_.substr(type + 1, end - type - 1);
    const auto order = value_of("fortran_order");
    header.fortran_order = text_.substr(order, 4) == "True";
    if (!header.fortran_order && text_.substr(order, 5) != "False") {
      fail(order, "expected True or False, found " + in_quotes(text_.substr(order, 12)));
    }
    // Python 2 wrote long integers with an L.
    for (auto k = value_of("shape"); (k = skip(k, "(, L")) < text_.size() && text_[k] != ')';) {
      std::int64_t count = 0;
      const auto [stop, error] =
          std::from_chars(text_.data() + k, text_.data() + text_.size(), count);
      if (error != std::errc() || count < 0) {
        fail(k, "expected a number of elements, found " + in_quotes(text_.substr(k, 12)));
      }
      header.shape.push_back(count);
      k = static_cast<std::size_t>(stop - text_.data());
    }
    return header;
  }

 private:
  [[noreturn]] void fail(std::size_t position, const std::string& message) const {
    throw InputError(path_ + ": at byte " + std::to_string(position) + ": " + message);
  }

  std::size_t byte(std::size_t k) const {
    if (k >= text_.size()) fail(text_.size(), "the file ends inside its header");
    return static_cast<unsigned char>(text_[k]);
  }

  std::size_t skip(std::size_t position, const char* characters) const {
    return std::min(text_.find_first_not_of(characters, position), text_.size());
  }

  // Where the value of a key begins.
  std::size_t value_of(const std::string& key) const {
    const auto found = std::min(text_.find("'" + key + "'"), text_.find('"' + key + '"'));
    if (found == std::string_view::npos) fail(text_.size(), "the header has no '" + key + "'");
    return skip(found + key.size() + 2, " :");
  }

  const std::string& path_;
  std::string_view text_;
};

template <class Stored, class Scalar>
std::vector<Scalar> converted(const std::string& owner, std::size_t count, std::string_view bytes) {
  if (count != bytes.size() / sizeof(Stored) || bytes.size() % sizeof(Stored) != 0) {
    throw InputError(owner + " has " + std::to_string(bytes.size()) + " bytes of numbers, but " +
                     std::to_string(count) + " numbers of " + std::to_string(sizeof(Stored)) +
                     " bytes are declared");
  }
  std::vector<Scalar> result(count);
  for (std::size_t k = 0; k < count; ++k) {
    const auto value = number_at<Stored>(bytes.data() + k * sizeof(Stored));
    bool fits = std::isfinite(static_cast<double>(value));
    if constexpr (std::is_integral_v<Scalar>) {
      fits = std::is_integral_v<Stored> &&
             static_cast<std::int64_t>(value) >= std::numeric_limits<Scalar>::min() &&
             static_cast<std::int64_t>(value) <= std::numeric_limits<Scalar>::max();
    }
    if (!fits) {
      throw InputError(owner + ": number " + std::to_string(k) + " is " +
                       format_number(static_cast<double>(value)) + ", which is not finite" +
                       (std::is_integral_v<Scalar> ? ", or no index" : ""));
    }
    result[k] = static_cast<Scalar>(value);
  }
  return result;
}

}  // namespace

template <class Scalar>
std::vector<Scalar> npy_numbers(const std::string& owner, const NpyHeader& header,
                                std::string_view bytes) {
  const auto& shape = header.shape;
  std::size_t count = std::find(shape.begin(), shape.end(), 0) == shape.end() ? 1 : 0;
  for (const auto length : shape) {
    if (count == 0) break;
    if (count > bytes.size() / static_cast<std::size_t>(length)) {
      throw InputError(owner + ": the file ends early");
    }
    count *= static_cast<std::size_t>(length);
  }
  if (header.type == "<f8") return converted<double, Scalar>(owner, count, bytes);
  if (header.type == "<f4") return converted<float, Scalar>(owner, count, bytes);
  if (header.type == "<i4") return converted<std::int32_t, Scalar>(owner, count, bytes);
  if (header.type == "<i8") return converted<std::int64_t, Scalar>(owner, count, bytes);
  throw InputError(owner + " has the type " + in_quotes(header.type) +
                   ", which is not supported; save the array with astype('<f8')");
}

template std::vector<double> npy_numbers(const std::string&, const NpyHeader&, std::string_view);
template std::vector<std::int32_t> npy_numbers(const std::string&, const NpyHeader&,
                                               std::string_view);
template std::vector<std::int64_t> npy_numbers(const std::string&, const NpyHeader&,
                                               std::string_view);

NpyHeader read_npy_header(const std::string& path, const std::string& content) {
  return Header(path, content).parse();
}

}  // namespace flbc::io
