// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/wide_property.h"

#include <array>
#include <cstdint>
#include <istream>
#include <limits>
#include <optional>
#include <ostream>

namespace flbc::openmesh {
namespace {

using Count = std::uint64_t;

constexpr std::array<char, 8> kMagic = {'f', 'l', 'b', 'c', 'r', 'o', 'w', '1'};
// .om files keep the size of a property in 32 bits.
constexpr Count kMostStoredBytes = std::numeric_limits<std::uint32_t>::max();

// What precedes the numbers. The shape is there twice, as the size it leads to, so that damage to
// one of them shows.
struct Header {
  Count scalar_bytes, components, width, elements, data_bytes;
};
constexpr std::size_t kHeaderBytes = kMagic.size() + sizeof(Header);

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw InputError("property '" + name + "' cannot be read: " + why);
}

template <class Number>
void reverse_bytes(Number& number) {
  auto* bytes = reinterpret_cast<char*>(&number);
  std::reverse(bytes, bytes + sizeof number);
}

template <class Number>
void write_numbers(std::ostream& out, const Number* numbers, std::size_t count, bool swap) {
  if (!swap) {
    out.write(reinterpret_cast<const char*>(numbers),
              static_cast<std::streamsize>(count * sizeof(Number)));
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    Number number = numbers[i];
    reverse_bytes(number);
    out.write(reinterpret_cast<const char*>(&number), sizeof number);
  }
}

template <class Number>
bool read_numbers(std::istream& in, Number* numbers, std::size_t count, bool swap) {
  in.read(reinterpret_cast<char*>(numbers), static_cast<std::streamsize>(count * sizeof(Number)));
  if (swap) std::for_each(numbers, numbers + count, reverse_bytes<Number>);
  return in.good();
}

// The product, or the largest number there is if it is larger.
Count product(Count a, Count b) {
  constexpr Count kMost = std::numeric_limits<Count>::max();
  return b > 0 && a > kMost / b ? kMost : a * b;
}

template <class Scalar>
Header header_of(const RowBlock<Scalar>& rows) {
  Header header{sizeof(Scalar), rows.components(), rows.width(), rows.size(), 0};
  header.data_bytes = rows.size() * rows.components() * rows.width() * sizeof(Scalar);
  return header;
}

template <class Scalar>
Header read_header(std::istream& in, bool swap, const std::string& name, Count elements) {
  std::array<char, kMagic.size()> magic{};
  std::array<Count, 5> fields{};
  if (!read_numbers(in, magic.data(), magic.size(), false)) refuse(name, "the file ends before it");
  if (magic != kMagic) refuse(name, "the file has a property of another type under this name");
  if (!read_numbers(in, fields.data(), fields.size(), swap)) refuse(name, "the file ends in it");
  const Header header{fields[0], fields[1], fields[2], fields[3], fields[4]};
  if (header.scalar_bytes != sizeof(Scalar)) {
    refuse(name, "the file does not have it in the mesh's precision, " +
                     std::string(sizeof(Scalar) == sizeof(float) ? "float" : "double"));
  }
  if (header.elements != elements) {
    refuse(name, "the file has it for " + std::to_string(header.elements) +
                     " elements, the mesh has " + std::to_string(elements));
  }
  const Count rows = product(header.elements, header.components);
  if (header.data_bytes > kMostStoredBytes || header.components > kMostStoredBytes ||
      header.width > kMostStoredBytes ||
      product(product(rows, header.width), sizeof(Scalar)) != header.data_bytes) {
    refuse(name, "its shape is damaged");
  }
  return header;
}

// Nothing if the stream cannot be asked.
std::optional<Count> bytes_left(std::istream& in) {
  const auto here = in.tellg();
  if (here < 0) return std::nullopt;
  in.seekg(0, std::ios::end);
  const auto end = in.tellg();
  in.seekg(here);
  return static_cast<Count>(end - here);
}

template <class Scalar>
RowBlock<Scalar> read_rows(std::istream& in, bool swap, const std::string& name,
                           const Header& header) {
  const auto left = bytes_left(in);
  if (left && *left < header.data_bytes) refuse(name, "the file ends in it");
  if (header.data_bytes == 0) {
    RowBlock<Scalar> rows(header.components, header.width);
    rows.resize(header.elements);
    return rows;
  }
  // One row at a time, so that a stream of unknown length gets memory for what it has.
  RowBlock<Scalar> rows(1, header.width);
  const std::size_t count = header.elements * header.components;
  if (left) rows.reserve(count);
  for (std::size_t r = 0; r < count; ++r) {
    rows.resize(r + 1);
    if (!read_numbers(in, rows[r].data(), header.width, swap)) {
      refuse(name, "the file ends in its element " + std::to_string(r / header.components));
    }
  }
  rows.regroup(header.components);
  return rows;
}

}  // namespace

template <class Scalar>
std::size_t stored_size(const RowBlock<Scalar>& rows) {
  return kHeaderBytes + header_of(rows).data_bytes;
}

template <class Scalar>
std::size_t store_rows(std::ostream& out, bool swap, const std::string& name,
                       const RowBlock<Scalar>& rows) {
  const std::size_t size = stored_size(rows);
  if (size > kMostStoredBytes) {
    throw IoError("property '" + name + "' takes " + std::to_string(size) +
                  " bytes, .om files hold at most " + std::to_string(kMostStoredBytes) +
                  " of one property");
  }
  const auto header = header_of(rows);
  const std::array<Count, 5> fields = {header.scalar_bytes, header.components, header.width,
                                       header.elements, header.data_bytes};
  write_numbers(out, kMagic.data(), kMagic.size(), false);
  write_numbers(out, fields.data(), fields.size(), swap);
  if (header.data_bytes > 0) {
    for (std::size_t e = 0; e < rows.size(); ++e) {
      for (std::size_t c = 0; c < rows.components(); ++c) {
        write_numbers(out, rows[e].row(c), rows.width(), swap);
      }
    }
  }
  return out.good() ? size : 0;
}

template <class Scalar>
std::size_t restore_rows(std::istream& in, bool swap, const std::string& name,
                         RowBlock<Scalar>& rows) {
  const auto header = read_header<Scalar>(in, swap, name, rows.size());
  try {
    rows = read_rows<Scalar>(in, swap, name, header);
  } catch (const std::bad_alloc&) {
    refuse(name, "there is not enough memory for it");
  }
  return stored_size(rows);
}

#define FLBC_INSTANTIATE(Scalar)                                           \
  template std::size_t stored_size(const RowBlock<Scalar>&);               \
  template std::size_t store_rows(std::ostream&, bool, const std::string&, \
                                  const RowBlock<Scalar>&);                \
  template std::size_t restore_rows(std::istream&, bool, const std::string&, RowBlock<Scalar>&);
FLBC_INSTANTIATE(float)
FLBC_INSTANTIATE(double)
#undef FLBC_INSTANTIATE

}  // namespace flbc::openmesh
