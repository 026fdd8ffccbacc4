// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/active_set/sweep_order.h"

#include <algorithm>

namespace flbc::active_set {
namespace {

// Few enough for many blocks of a colour, enough to find neighbours in the cache.
constexpr Index kBlock = 32;

// The smallest colour that none of the blocks coupled to it has.
std::vector<Index> colours_of_blocks(const RowMatrix& matrix, Index num_blocks) {
  constexpr Index kNone = -1;
  std::vector<Index> colour(num_blocks, kNone);
  std::vector<Index> taken_by;  // by colour: the last block that may not have it
  for (Index block = 0; block < num_blocks; ++block) {
    const auto end = std::min<Index>((block + 1) * kBlock, static_cast<Index>(matrix.rows()));
    for (Index row = block * kBlock; row < end; ++row) {
      for (RowMatrix::InnerIterator it(matrix, row); it; ++it) {
        const Index other = colour[it.col() / kBlock];
        if (other != kNone) taken_by[other] = block;
      }
    }
    const auto free =
        std::find_if(taken_by.begin(), taken_by.end(), [&](Index taken) { return taken != block; });
    colour[block] = static_cast<Index>(free - taken_by.begin());
    if (free == taken_by.end()) taken_by.push_back(kNone);
  }
  return colour;
}

}  // namespace

SweepOrder sweep_order(const RowMatrix& matrix) {
  const auto size = static_cast<Index>(matrix.rows());
  const Index num_blocks = (size + kBlock - 1) / kBlock;
  const auto colour = colours_of_blocks(matrix, num_blocks);
  std::vector<Index> blocks(num_blocks);
  for (Index block = 0; block < num_blocks; ++block) blocks[block] = block;
  std::stable_sort(blocks.begin(), blocks.end(),
                   [&](Index a, Index b) { return colour[a] < colour[b]; });
  SweepOrder order;
  order.position.resize(size);
  Index next = 0;
  for (Index place = 0; place < num_blocks; ++place) {
    const Index block = blocks[place];
    if (place == 0 || colour[block] != colour[blocks[place - 1]]) {
      order.colour_starts.push_back(place);
    }
    order.block_starts.push_back(next);
    const Index end = std::min((block + 1) * kBlock, size);
    for (Index unknown = block * kBlock; unknown < end; ++unknown) order.position[unknown] = next++;
  }
  order.block_starts.push_back(next);
  order.colour_starts.push_back(num_blocks);
  return order;
}

}  // namespace flbc::active_set
