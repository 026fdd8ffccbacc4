// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/influences.h"

#include <array>
#include <new>

#include "number_stream.h"

namespace flbc::openmesh {
namespace {

constexpr Magic kPairsMagic = {'f', 'l', 'b', 'c', 'i', 'n', 'f', '1'};
constexpr Count kPairBytes = sizeof(std::uint32_t) + sizeof(double);

// Header before the pairs; all control points come before all weights. The size is stored
// redundantly with the shape, to detect damage.
struct PairsHeader {
  Count control_points, most, elements, data_bytes;
};
constexpr std::size_t kPairsHeaderBytes = kPairsMagic.size() + sizeof(PairsHeader);

PairsHeader read_pairs_header(std::istream& in, bool swap, const std::string& name,
                              Count elements) {
  const auto fields = read_header<4>(in, swap, name, kPairsMagic);
  const PairsHeader header{fields[0], fields[1], fields[2], fields[3]};
  require_elements(name, header.elements, elements);
  if (header.data_bytes > kMostStoredBytes || header.most > kMostStoredBytes ||
      product(product(header.elements, header.most), kPairBytes) != header.data_bytes) {
    refuse_stored(name, "its shape is damaged");
  }
  return header;
}

InfluenceBlock read_pairs(std::istream& in, bool swap, const std::string& name,
                          const PairsHeader& header) {
  const auto left = bytes_left(in);
  if (left && *left < header.data_bytes) refuse_stored(name, "the file ends within the property");
  InfluenceBlock block(header.control_points, header.most);
  block.resize(header.elements);
  const std::size_t count = header.elements * header.most;
  if (count == 0) return block;
  if (!read_numbers(in, block.control_points(), count, swap) ||
      !read_numbers(in, block.weights(), count, swap)) {
    refuse_stored(name, "the file ends within the property");
  }
  for (std::size_t j = 0; j < count; ++j) {
    if (block.control_points()[j] < header.control_points) continue;
    refuse_stored(name, "its element " + std::to_string(j / header.most) + " names control point " +
                            std::to_string(block.control_points()[j]) + " of " +
                            std::to_string(header.control_points));
  }
  return block;
}

}  // namespace

std::size_t stored_size(const InfluenceBlock& block) {
  return kPairsHeaderBytes + block.size() * block.most() * kPairBytes;
}

std::size_t store_block(std::ostream& out, bool swap, const std::string& name,
                        const InfluenceBlock& block) {
  const std::size_t size = stored_size(block);
  require_storable(name, size);
  write_header<4>(
      out, swap, kPairsMagic,
      {block.num_control_points(), block.most(), block.size(), size - kPairsHeaderBytes});
  const std::size_t count = block.size() * block.most();
  if (count > 0) {
    write_numbers(out, block.control_points(), count, swap);
    write_numbers(out, block.weights(), count, swap);
  }
  return out.good() ? size : 0;
}

std::size_t restore_block(std::istream& in, bool swap, const std::string& name,
                          InfluenceBlock& block) {
  const auto header = read_pairs_header(in, swap, name, block.size());
  try {
    block = read_pairs(in, swap, name, header);
  } catch (const std::bad_alloc&) {
    refuse_stored(name, "there is not enough memory for it");
  }
  return stored_size(block);
}

}  // namespace flbc::openmesh
