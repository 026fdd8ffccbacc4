// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/wide_property.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "number_stream.h"

namespace flbc::openmesh {
namespace {

constexpr Magic kRowsMagic = {'f', 'l', 'b', 'c', 'r', 'o', 'w', '1'};

// Header before the values. The size is stored redundantly with the shape, to detect damage.
struct RowsHeader {
  Count scalar_bytes, components, width, elements, data_bytes;
};
constexpr std::size_t kRowsHeaderBytes = kRowsMagic.size() + sizeof(RowsHeader);

template <class Scalar>
RowsHeader header_of(const RowBlock<Scalar>& rows) {
  RowsHeader header{sizeof(Scalar), rows.components(), rows.width(), rows.size(), 0};
  header.data_bytes = rows.size() * rows.components() * rows.width() * sizeof(Scalar);
  return header;
}

template <class Scalar>
RowsHeader read_rows_header(std::istream& in, bool swap, const std::string& name, Count elements) {
  const auto fields = read_header<5>(in, swap, name, kRowsMagic);
  const RowsHeader header{fields[0], fields[1], fields[2], fields[3], fields[4]};
  if (header.scalar_bytes != sizeof(Scalar)) {
    refuse_stored(name, "the file has it in another precision than the mesh, " +
                            std::string(sizeof(Scalar) == sizeof(float) ? "float" : "double"));
  }
  require_elements(name, header.elements, elements);
  const Count rows = product(header.elements, header.components);
  if (header.data_bytes > kMostStoredBytes || header.components > kMostStoredBytes ||
      header.width > kMostStoredBytes ||
      product(product(rows, header.width), sizeof(Scalar)) != header.data_bytes) {
    refuse_stored(name, "its shape is damaged");
  }
  return header;
}

template <class Scalar>
RowBlock<Scalar> read_rows(std::istream& in, bool swap, const std::string& name,
                           const RowsHeader& header) {
  const auto left = bytes_left(in);
  if (left && *left < header.data_bytes) refuse_stored(name, "the file ends within the property");
  // Reads in blocks, so that a stream of unknown length allocates memory only for its data.
  constexpr std::size_t kAtOnce = 1 << 16;
  const std::size_t count = header.data_bytes / sizeof(Scalar);
  std::vector<Scalar> numbers;
  if (left) numbers.reserve(count);
  for (std::size_t done = 0; done < count; done = numbers.size()) {
    const std::size_t more = std::min(count - done, kAtOnce);
    numbers.resize(done + more);
    if (!read_numbers(in, numbers.data() + done, more, swap)) {
      refuse_stored(name, "the file ends within the property");
    }
  }
  RowBlock<Scalar> rows(header.components, header.width);
  rows.assign(header.elements, std::move(numbers));
  return rows;
}

}  // namespace

template <class Scalar>
std::size_t stored_size(const RowBlock<Scalar>& rows) {
  return kRowsHeaderBytes + header_of(rows).data_bytes;
}

template <class Scalar>
std::size_t store_block(std::ostream& out, bool swap, const std::string& name,
                        const RowBlock<Scalar>& rows) {
  const std::size_t size = stored_size(rows);
  require_storable(name, size);
  const auto header = header_of(rows);
  write_header<5>(
      out, swap, kRowsMagic,
      {header.scalar_bytes, header.components, header.width, header.elements, header.data_bytes});
  write_numbers(out, rows.data(), rows.size() * rows.element_size(), swap);
  return out.good() ? size : 0;
}

template <class Scalar>
std::size_t restore_block(std::istream& in, bool swap, const std::string& name,
                          RowBlock<Scalar>& rows) {
  const auto header = read_rows_header<Scalar>(in, swap, name, rows.size());
  try {
    rows = read_rows<Scalar>(in, swap, name, header);
  } catch (const std::bad_alloc&) {
    refuse_stored(name, "there is not enough memory for it");
  }
  return stored_size(rows);
}

#define FLBC_INSTANTIATE(Scalar)                                            \
  template std::size_t stored_size(const RowBlock<Scalar>&);                \
  template std::size_t store_block(std::ostream&, bool, const std::string&, \
                                   const RowBlock<Scalar>&);                \
  template std::size_t restore_block(std::istream&, bool, const std::string&, RowBlock<Scalar>&);
FLBC_INSTANTIATE(float)
FLBC_INSTANTIATE(double)
#undef FLBC_INSTANTIATE

}  // namespace flbc::openmesh
