// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A property of OpenMesh meshes whose elements are rows of numbers, all in one aligned block: what
//! the solver works on in place, and what OpenMesh's own tools copy, sort, save and load.
//!
//!     OpenMesh::VProp<flbc::openmesh::Wide<double>> weights(mesh, "flbc:weights");
//!     mesh.property(weights.getRawProperty()).set_shape(1, cage_size);
//!     weights[vertex][i] = 0.5;
#pragma once

#include <cassert>
#include <cstddef>
#include <iosfwd>
#include <string>
#include <type_traits>

#include <OpenMesh/Core/System/config.h>
#include <OpenMesh/Core/Utils/Property.hh>
#include <OpenMesh/Core/Utils/PropertyCreator.hh>

// Specialises PropertyT, which before 9.0 had another interface.
#if OM_VERSION < 0x90000
#error "flbc's bindings need OpenMesh 9.0 or later"
#endif

#include "flbc/openmesh/row_block.h"

namespace flbc::openmesh {

//! Value type of a wide property: an element is a block of rows of Scalars, seen as RowsView.
template <class Scalar>
struct Wide {
  static_assert(std::is_same_v<Scalar, float> || std::is_same_v<Scalar, double>,
                "wide properties hold float or double");
};

//! Bytes that store_rows() writes: the shape and the numbers without padding.
template <class Scalar>
std::size_t stored_size(const RowBlock<Scalar>& rows);

//! Writes a block as .om files hold it. \return bytes written, 0 if the stream fails
//! \throws IoError if the block is larger than .om files allow, 4 GiB - 1
template <class Scalar>
std::size_t store_rows(std::ostream& out, bool swap, const std::string& name,
                       const RowBlock<Scalar>& rows);

//! Reads what store_rows() wrote; leaves `rows` as it is if that fails. Never takes much more
//! memory than the stream has data. \return bytes read
//! \throws InputError if this is no block of Scalars for rows.size() elements, or a damaged one.
//! (OpenMesh's reader does not look at streams that failed, and would read on forever.)
template <class Scalar>
std::size_t restore_rows(std::istream& in, bool swap, const std::string& name,
                         RowBlock<Scalar>& rows);

}  // namespace flbc::openmesh

namespace OpenMesh {

//! The type that mesh.property(handle, element) returns.
template <class Scalar>
struct BasePropHandleT<flbc::openmesh::Wide<Scalar>> : public BaseHandle {
  using Value = flbc::openmesh::Wide<Scalar>;
  using value_type = Value;
  using vector_type = flbc::openmesh::RowBlock<Scalar>;
  using reference = flbc::openmesh::RowsView<Scalar>;
  using const_reference = flbc::openmesh::RowsView<const Scalar>;

  explicit BasePropHandleT(int index = -1) : BaseHandle(index) {}
};

//! Every element has `components` rows of `width` numbers, at first 1 and 0: call set_shape().
template <class Scalar>
class PropertyT<flbc::openmesh::Wide<Scalar>> : public BaseProperty {
 public:
  using Value = flbc::openmesh::Wide<Scalar>;
  using value_type = Value;
  using vector_type = flbc::openmesh::RowBlock<Scalar>;
  using reference = flbc::openmesh::RowsView<Scalar>;
  using const_reference = flbc::openmesh::RowsView<const Scalar>;

  explicit PropertyT(const std::string& name = "<unknown>",
                     const std::string& internal_type_name = "<unknown>")
      : BaseProperty(name, internal_type_name) {}

  //! Gives all elements another shape and sets them to zero.
  //! \throws std::bad_alloc, and then nothing has changed
  void set_shape(std::size_t components, std::size_t width) {
    vector_type rows(components, width);
    rows.resize(rows_.size());
    rows_ = std::move(rows);
  }
  std::size_t components() const { return rows_.components(); }
  std::size_t width() const { return rows_.width(); }
  //! Numbers from one row to the next, a multiple of 8: width() and its padding, which is zero.
  std::size_t stride() const { return rows_.stride(); }

  //! Element e, component c, number i is at [(e * components() + c) * stride() + i]; aligned to 64
  //! bytes. Null as long as there are no numbers.
  Scalar* data() { return rows_.data(); }
  const Scalar* data() const { return rows_.data(); }
  //! Of all elements, with padding.
  std::size_t bytes() const { return n_elements() * rows_.element_size() * sizeof(Scalar); }

  //! Element e. No range check, as everywhere in OpenMesh.
  reference operator[](int e) {
    assert(static_cast<std::size_t>(e) < n_elements());
    return rows_[static_cast<std::size_t>(e)];
  }
  const_reference operator[](int e) const {
    assert(static_cast<std::size_t>(e) < n_elements());
    return rows_[static_cast<std::size_t>(e)];
  }

  //! For PropertyManager, which swaps it; keep its number of elements.
  vector_type& data_vector() { return rows_; }
  const vector_type& data_vector() const { return rows_; }

  // The synchronized array. New elements are zero; clear() frees the memory and keeps the shape.
  void reserve(std::size_t elements) override { rows_.reserve(elements); }
  void resize(std::size_t elements) override { rows_.resize(elements); }
  void clear() override { rows_.clear(); }
  void push_back() override { rows_.resize(rows_.size() + 1); }
  void swap(std::size_t first, std::size_t second) override { rows_.swap(first, second); }
  void copy(std::size_t from, std::size_t to) override { rows_.copy(from, to); }
  PropertyT* clone() const override { return new PropertyT(*this); }

  // .om files.
  void set_persistent(bool yes) override { check_and_set_persistent<Value>(yes); }
  std::string get_storage_name() const override { return IO::binary<Value>::type_identifier(); }
  std::size_t n_elements() const override { return rows_.size(); }
  //! Unknown, always: OpenMesh asks before it reads a property, and its shape is in the file.
  std::size_t element_size() const override { return UnknownSize; }
  std::size_t size_of(std::size_t /*elements*/) const override { return UnknownSize; }
  //! Bytes in an .om file.
  std::size_t size_of() const override { return flbc::openmesh::stored_size(rows_); }
  std::size_t store(std::ostream& out, bool swap_bytes) const override {
    return flbc::openmesh::store_rows(out, swap_bytes, name(), rows_);
  }
  //! A property read from a file is written into the next one.
  std::size_t restore(std::istream& in, bool swap_bytes) override {
    const std::size_t bytes = flbc::openmesh::restore_rows(in, swap_bytes, name(), rows_);
    set_persistent(true);
    return bytes;
  }

 private:
  vector_type rows_;
};

namespace IO {

//! Tells OpenMesh that wide properties can be saved, and under which name.
template <class Scalar>
struct binary<flbc::openmesh::Wide<Scalar>> {
  using value_type = flbc::openmesh::Wide<Scalar>;
  static const bool is_streamable = true;
  static std::size_t size_of() { return UnknownSize; }
  static std::size_t size_of(const value_type&) { return UnknownSize; }
  static std::string type_identifier() {
    return std::is_same_v<Scalar, float> ? "flbc::Wide<float>" : "flbc::Wide<double>";
  }
};

}  // namespace IO
}  // namespace OpenMesh

namespace flbc::openmesh {

//! Makes the properties of a file in a mesh that has none of their name. This is what
//! OM_REGISTER_PROPERTY_TYPE makes, once per program instead of once per source file; its variables
//! are named by their line only and could collide with those of another header.
template <class Scalar>
class WideCreator : public OpenMesh::PropertyCreatorImpl<WideCreator<Scalar>> {
 public:
  using type = Wide<Scalar>;
  WideCreator() { OpenMesh::PropertyCreationManager::instance().register_property_creator(this); }
  std::string type_string() override { return OpenMesh::IO::binary<type>::type_identifier(); }
};
inline WideCreator<float> wide_float_creator;
inline WideCreator<double> wide_double_creator;

}  // namespace flbc::openmesh
