// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A property of OpenMesh meshes whose elements are a few control points with their weights: the
//! form of sparse weights on a mesh. OpenMesh's own tools copy, sort, save and load it.
//!
//!     OpenMesh::VProp<flbc::openmesh::Influences> weights(mesh, "flbc:weights");
//!     for (std::size_t j = 0; j < weights[vertex].count(); ++j)
//!       use(weights[vertex].control_point(j), weights[vertex].weight(j));
#pragma once

#include <cassert>
#include <cstddef>
#include <iosfwd>
#include <string>

#include <OpenMesh/Core/System/config.h>
#include <OpenMesh/Core/Utils/Property.hh>
#include <OpenMesh/Core/Utils/PropertyCreator.hh>

#include "flbc/openmesh/influence_block.h"

// Specialises PropertyT, which before 9.0 had another interface.
#if OM_VERSION < 0x90000
#error "flbc's bindings need OpenMesh 9.0 or later"
#endif

namespace flbc::openmesh {

//! Value type of a property of few weights per element, seen as InfluencesView.
struct Influences {};

//! Bytes that store_influences() writes.
std::size_t stored_size(const InfluenceBlock& block);

//! Writes a block as .om files hold it. \return bytes written, 0 if the stream fails
//! \throws IoError if the block is larger than .om files allow, 4 GiB - 1
std::size_t store_influences(std::ostream& out, bool swap, const std::string& name,
                             const InfluenceBlock& block);

//! Reads what store_influences() wrote; leaves `block` as it is if that fails.
//! \return bytes read
//! \throws InputError if this is no block for block.size() elements, or a damaged one
std::size_t restore_influences(std::istream& in, bool swap, const std::string& name,
                               InfluenceBlock& block);

}  // namespace flbc::openmesh

namespace OpenMesh {

//! The type that mesh.property(handle, element) returns.
template <>
struct BasePropHandleT<flbc::openmesh::Influences> : public BaseHandle {
  using Value = flbc::openmesh::Influences;
  using value_type = Value;
  using vector_type = flbc::openmesh::InfluenceBlock;
  using reference = flbc::openmesh::InfluencesView<double>;
  using const_reference = flbc::openmesh::InfluencesView<const double>;

  explicit BasePropHandleT(int index = -1) : BaseHandle(index) {}
};

//! Every element has the same number of pairs, at first 0: call set_shape().
template <>
class PropertyT<flbc::openmesh::Influences> : public BaseProperty {
 public:
  using Value = flbc::openmesh::Influences;
  using value_type = Value;
  using vector_type = flbc::openmesh::InfluenceBlock;
  using reference = flbc::openmesh::InfluencesView<double>;
  using const_reference = flbc::openmesh::InfluencesView<const double>;

  explicit PropertyT(const std::string& name = "<unknown>",
                     const std::string& internal_type_name = "<unknown>")
      : BaseProperty(name, internal_type_name) {}

  //! Gives all elements another number of pairs and sets them to 0.
  //! \param num_control_points  n \param most  pairs per element
  void set_shape(std::size_t num_control_points, std::size_t most) {
    vector_type block(num_control_points, most);
    block.resize(block_.size());
    block_ = std::move(block);
  }
  std::size_t num_control_points() const { return block_.num_control_points(); }
  std::size_t most() const { return block_.most(); }

  //! Element e. No range check, as everywhere in OpenMesh.
  reference operator[](int e) {
    assert(static_cast<std::size_t>(e) < n_elements());
    return block_[static_cast<std::size_t>(e)];
  }
  const_reference operator[](int e) const {
    assert(static_cast<std::size_t>(e) < n_elements());
    return block_[static_cast<std::size_t>(e)];
  }

  //! For PropertyManager, which swaps it; keep its number of elements.
  vector_type& data_vector() { return block_; }
  const vector_type& data_vector() const { return block_; }

  // The synchronized array. New elements are 0; clear() frees the memory and keeps the shape.
  void reserve(std::size_t elements) override { block_.reserve(elements); }
  void resize(std::size_t elements) override { block_.resize(elements); }
  void clear() override { block_.clear(); }
  void push_back() override { block_.resize(block_.size() + 1); }
  void swap(std::size_t first, std::size_t second) override { block_.swap(first, second); }
  void copy(std::size_t from, std::size_t to) override { block_.copy(from, to); }
  PropertyT* clone() const override { return new PropertyT(*this); }

  // .om files.
  void set_persistent(bool yes) override;
  std::string get_storage_name() const override { return "flbc::Influences"; }
  std::size_t n_elements() const override { return block_.size(); }
  //! Unknown, always: OpenMesh asks before it reads a property, and its shape is in the file.
  std::size_t element_size() const override { return UnknownSize; }
  std::size_t size_of(std::size_t /*elements*/) const override { return UnknownSize; }
  //! Bytes in an .om file.
  std::size_t size_of() const override { return flbc::openmesh::stored_size(block_); }
  std::size_t store(std::ostream& out, bool swap_bytes) const override {
    return flbc::openmesh::store_influences(out, swap_bytes, name(), block_);
  }
  //! A property read from a file is written into the next one.
  std::size_t restore(std::istream& in, bool swap_bytes) override {
    const std::size_t bytes = flbc::openmesh::restore_influences(in, swap_bytes, name(), block_);
    set_persistent(true);
    return bytes;
  }

 private:
  vector_type block_;
};

namespace IO {

//! Tells OpenMesh that influences can be saved, and under which name.
template <>
struct binary<flbc::openmesh::Influences> {
  using value_type = flbc::openmesh::Influences;
  static const bool is_streamable = true;
  static std::size_t size_of() { return UnknownSize; }
  static std::size_t size_of(const value_type&) { return UnknownSize; }
  static std::string type_identifier() { return "flbc::Influences"; }
};

}  // namespace IO

inline void PropertyT<flbc::openmesh::Influences>::set_persistent(bool yes) {
  check_and_set_persistent<Value>(yes);
}

}  // namespace OpenMesh

namespace flbc::openmesh {

//! Makes the property of a file in a mesh that has none of its name, as WideCreator does.
class InfluencesCreator : public OpenMesh::PropertyCreatorImpl<InfluencesCreator> {
 public:
  using type = Influences;
  InfluencesCreator() {
    OpenMesh::PropertyCreationManager::instance().register_property_creator(this);
  }
  std::string type_string() override { return OpenMesh::IO::binary<type>::type_identifier(); }
};
inline InfluencesCreator influences_creator;

}  // namespace flbc::openmesh
