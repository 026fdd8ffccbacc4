// SPDX-License-Identifier: BSD-3-Clause
#include "weights/npz.h"

#include <array>
#include <limits>
#include <ostream>

#include "flbc/errors.h"
#include "flbc/io/files.h"

namespace flbc::io {
namespace {

constexpr const char* kLocal = "PK\x03\x04";
constexpr const char* kCentral = "PK\x01\x02";
constexpr const char* kEnd = "PK\x05\x06";

// The check sum of zip files.
std::uint32_t crc32(const std::string& head, const char* data, std::size_t size) {
  static const auto table = [] {
    std::array<std::uint32_t, 256> sums{};
    for (std::uint32_t k = 0; k < 256; ++k) {
      std::uint32_t sum = k;
      for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ (sum & 1 ? 0xedb88320U : 0);
      sums[k] = sum;
    }
    return sums;
  }();
  std::uint32_t sum = 0xffffffffU;
  const auto add = [&](const char* bytes, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) {
      sum = table[(sum ^ static_cast<unsigned char>(bytes[k])) & 0xff] ^ (sum >> 8);
    }
  };
  add(head.data(), head.size());
  add(data, size);
  return ~sum;
}

struct Number {
  std::size_t value;
  int bytes;
};

void put(std::string& text, const std::vector<Number>& numbers) {
  for (const auto& [value, bytes] : numbers) {
    for (int k = 0; k < bytes; ++k) text += static_cast<char>(value >> (8 * k) & 0xff);
  }
}

}  // namespace

void NpzWriter::write(const char* data, std::size_t size) {
  out_.write(data, static_cast<std::streamsize>(size));
  offset_ += size;
}

void NpzWriter::add_bytes(const std::string& name, const std::string& type,
                          const std::vector<std::int64_t>& shape, const void* data,
                          std::size_t bytes) {
  const auto head = npy_header(type, shape);
  // Larger files would need another version of the format.
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max() - std::size_t{65536};
  if (bytes > kMost || offset_ > kMost - bytes) {
    throw IoError(path_ + ": the archive is larger than 4 GB; use a coarser mesh");
  }
  const auto* numbers = static_cast<const char*>(data);
  const auto file = name + ".npy";
  // Version, flags, compression, time, date, check sum, both sizes, length of the name, no extra.
  std::string entry;
  put(entry, {{20, 2}, {0, 2}, {0, 2}, {0, 2}, {0x21, 2}, {crc32(head, numbers, bytes), 4}});
  put(entry, {{head.size() + bytes, 4}, {head.size() + bytes, 4}, {file.size(), 2}, {0, 2}});
  directory_ += kCentral;
  put(directory_, {{20, 2}});
  directory_ += entry;
  put(directory_, {{0, 2}, {0, 2}, {0, 2}, {0, 4}, {offset_, 4}});
  directory_ += file;
  ++count_;
  const auto start = kLocal + entry + file + head;
  write(start.data(), start.size());
  write(numbers, bytes);
}

void NpzWriter::finish() {
  const auto begin = offset_, size = directory_.size();
  directory_ += kEnd;
  put(directory_, {{0, 2}, {0, 2}, {count_, 2}, {count_, 2}, {size, 4}, {begin, 4}, {0, 2}});
  write(directory_.data(), directory_.size());
}

void NpzReader::fail(const std::string& message) const {
  throw InputError(path_ + ": " + message);
}

NpzReader::NpzReader(const std::string& path) : NpzReader(path, read_file(path)) {
}

NpzReader::NpzReader(std::string path, std::string content)
    : path_(std::move(path)), content_(std::move(content)) {
  const auto number = [&](std::size_t position, int bytes) {
    if (position + static_cast<std::size_t>(bytes) > content_.size()) fail("the file is damaged");
    std::size_t value = 0;
    for (int k = 0; k < bytes; ++k) {
      value |= std::size_t{static_cast<unsigned char>(content_[position + k])} << (8 * k);
    }
    return value;
  };
  const auto is_at = [&](std::size_t position, const char* mark) {
    return content_.compare(std::min(position, content_.size()), 4, mark) == 0;
  };
  const auto end = content_.rfind(kEnd);
  if (!is_at(0, kLocal) || end == std::string::npos) {
    fail("not an archive of NumPy arrays, or the file ends early");
  }
  std::size_t entry = number(end + 16, 4);
  for (std::size_t k = number(end + 10, 2); k > 0; --k) {
    if (!is_at(entry, kCentral)) fail("the file is damaged");
    if (number(entry + 10, 2) != 0) {
      fail(
          "the arrays are compressed; save them by numpy.savez or scipy.sparse.save_npz(..., "
          "compressed=False)");
    }
    const auto size = number(entry + 24, 4), length = number(entry + 28, 2),
               local = number(entry + 42, 4);
    auto name = content_.substr(std::min(entry + 46, content_.size()), length);
    const auto begin = local + 30 + number(local + 26, 2) + number(local + 28, 2);
    if (begin > content_.size() || size > content_.size() - begin) fail("the file ends early");
    const auto header = read_npy_header(path_ + " (" + name + ")", content_.substr(begin, size));
    if (name.size() > 4) name.resize(name.size() - 4);  // .npy
    arrays_[name] = {header, begin + header.size, size - header.size};
    entry += 46 + length + number(entry + 30, 2) + number(entry + 32, 2);
  }
}

const NpzReader::Array& NpzReader::array(const std::string& name) const {
  const auto found = arrays_.find(name);
  if (found == arrays_.end()) fail("there is no array '" + name + "'");
  return found->second;
}

template <class Scalar>
std::vector<Scalar> NpzReader::numbers(const std::string& name, int columns) const {
  const auto& found = array(name);
  const auto& header = found.header;
  const auto begin = found.begin, size = found.size;
  const std::size_t dimensions = columns > 0 ? 2 : 1;
  if (header.shape.size() != dimensions || (columns > 0 && header.shape[1] != columns) ||
      (header.fortran_order && columns > 1)) {
    fail("array '" + name + "' has another shape than bindings have");
  }
  return npy_numbers<Scalar>(path_ + ": array '" + name + "'", header,
                             std::string_view(content_).substr(begin, size));
}

template std::vector<double> NpzReader::numbers(const std::string&, int) const;
template std::vector<std::int32_t> NpzReader::numbers(const std::string&, int) const;
template std::vector<std::int64_t> NpzReader::numbers(const std::string&, int) const;

std::string NpzReader::text(const std::string& name) const {
  const auto& [header, begin, size] = array(name);
  if (header.type.compare(0, 2, "|S") != 0) fail("array '" + name + "' is not a text");
  return content_.substr(begin, size);
}

}  // namespace flbc::io
