// SPDX-License-Identifier: BSD-3-Clause
// Readers of properties in .om files.
#include <sstream>
#include <string>

#include "flbc/openmesh/influences.h"
#include "flbc/openmesh/wide_property.h"
#include "fuzz/reader.h"

namespace flbc::fuzz {
namespace {

constexpr std::size_t kElements = 3;

template <class Scalar>
void read_rows(const std::string& path) {
  std::istringstream in(get_file(path));
  openmesh::RowBlock<Scalar> rows;
  rows.resize(kElements);
  openmesh::restore_block(in, false, "rows", rows);
  require(rows.size() == kElements, "there are as many elements as before");
}

void read_influences(const std::string& path) {
  std::istringstream in(get_file(path));
  openmesh::InfluenceBlock block;
  block.resize(kElements);
  openmesh::restore_block(in, false, "influences", block);
  require(block.size() == kElements, "there are as many elements as before");
  for (std::size_t j = 0; j < block.size() * block.most(); ++j) {
    require(block.control_points()[j] < block.num_control_points(), "control points in range");
  }
}

template <class Scalar>
std::string stored_rows() {
  openmesh::RowBlock<Scalar> rows(2, 3);
  rows.resize(kElements);
  std::ostringstream out;
  openmesh::store_block(out, false, "rows", rows);
  return out.str();
}

std::string stored_influences() {
  openmesh::InfluenceBlock block(5, 2);
  block.resize(kElements);
  std::ostringstream out;
  openmesh::store_block(out, false, "influences", block);
  return out.str();
}

}  // namespace

std::vector<Reader> openmesh_readers() {
  return {{"rows", "input.rows", read_rows<double>, {stored_rows<double>()}},
          {"rows_single", "input.rows", read_rows<float>, {stored_rows<float>()}},
          {"influences", "input.pairs", read_influences, {stored_influences()}}};
}

}  // namespace flbc::fuzz
