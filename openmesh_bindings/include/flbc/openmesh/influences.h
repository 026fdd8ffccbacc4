// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A property of OpenMesh meshes for sparse weights: a few control points with their weights per
//! element.
//!
//!     OpenMesh::VProp<flbc::openmesh::Influences> weights(mesh, "flbc:weights");
//!     for (std::size_t j = 0; j < weights[vertex].count(); ++j)
//!       use(weights[vertex].control_point(j), weights[vertex].weight(j));
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>

#include "flbc/openmesh/block_property.h"
#include "flbc/openmesh/influence_block.h"

namespace flbc::openmesh {

//! Value type of a property with few weights per element, accessed as InfluencesView.
struct Influences {};

template <>
struct BlockOf<Influences> {
  using Block = InfluenceBlock;
  static constexpr const char* kName = "flbc::Influences";
};

//! Bytes that store_block() writes.
std::size_t stored_size(const InfluenceBlock& block);

//! Writes a block in the format of .om files. \return bytes written, 0 if the stream fails
//! \throws IoError if the block exceeds the limit of .om files, 4 GiB - 1
std::size_t store_block(std::ostream& out, bool swap, const std::string& name,
                        const InfluenceBlock& block);

//! Reads the output of store_block(); `block` is unchanged on failure. \return bytes read
//! \throws InputError if this is not a block for block.size() elements, or is damaged
std::size_t restore_block(std::istream& in, bool swap, const std::string& name,
                          InfluenceBlock& block);

}  // namespace flbc::openmesh

namespace OpenMesh {

namespace IO {

template <>
struct binary<flbc::openmesh::Influences>
    : flbc::openmesh::BlockBinary<flbc::openmesh::Influences> {};

}  // namespace IO

//! The type that mesh.property(handle, element) returns.
template <>
struct BasePropHandleT<flbc::openmesh::Influences>
    : BaseHandle, flbc::openmesh::BlockTypes<flbc::openmesh::Influences> {
  explicit BasePropHandleT(int index = -1) : BaseHandle(index) {}
};

//! Every element has the same number of pairs, initially 0; set_shape() changes it.
template <>
class PropertyT<flbc::openmesh::Influences>
    : public flbc::openmesh::BlockProperty<flbc::openmesh::Influences> {
 public:
  using BlockProperty::BlockProperty;

  //! Changes the number of pairs of all elements and sets them to 0.
  //! \param num_control_points  n \param most  pairs per element
  void set_shape(std::size_t num_control_points, std::size_t most) {
    set_block_shape(num_control_points, most);
  }
  std::size_t num_control_points() const { return data_vector().num_control_points(); }
  std::size_t most() const { return data_vector().most(); }
};

}  // namespace OpenMesh

namespace flbc::openmesh {

inline BlockCreator<Influences> influences_creator;

}  // namespace flbc::openmesh
