// SPDX-License-Identifier: BSD-3-Clause
#include "weights/npy_header.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

#include "flbc/errors.h"
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

}  // namespace

NpyHeader read_npy_header(const std::string& path, const std::string& content) {
  return Header(path, content).parse();
}

}  // namespace flbc::io
