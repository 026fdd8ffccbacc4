// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Properties of OpenMesh meshes with the same number of values for every element, stored in one
//! block. OpenMesh copies and sorts them like any other property.
#pragma once

#include <cassert>
#include <cstddef>
#include <string>
#include <utility>

#include <OpenMesh/Core/System/config.h>
#include <OpenMesh/Core/Utils/Property.hh>
#include <OpenMesh/Core/Utils/PropertyManager.hh>

#include "flbc/errors.h"

// Specializes PropertyT, whose interface changed in 9.0.
#if OM_VERSION < 0x90000
#error "flbc's bindings need OpenMesh 9.0 or later"
#endif

namespace flbc::openmesh {

//! Types required by OpenMesh. \tparam V  with the type of the storage, `Block`, whose operator[]
//! returns a view of an element
template <class V>
struct BlockTypes {
  using Value = V;
  using value_type = V;
  using vector_type = typename V::Block;
  using reference = decltype(std::declval<vector_type&>()[0]);
  using const_reference = decltype(std::declval<const vector_type&>()[0]);
};

//! Base of PropertyT<V>.
template <class V>
class BlockProperty : public OpenMesh::BaseProperty, public BlockTypes<V> {
 public:
  using typename BlockTypes<V>::vector_type;
  using typename BlockTypes<V>::reference;
  using typename BlockTypes<V>::const_reference;

  explicit BlockProperty(const std::string& name = "<unknown>",
                         const std::string& internal_type_name = "<unknown>")
      : OpenMesh::BaseProperty(name, internal_type_name) {}

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
  // After clean(), which keeps the elements, add_vertex() asks for one element: it is new as well.
  void resize(std::size_t elements) override {
    if (elements == 1 && block_.size() > 1) block_.resize(0);
    block_.resize(elements);
  }
  void clear() override { block_.clear(); }
  void push_back() override { block_.resize(block_.size() + 1); }
  void swap(std::size_t first, std::size_t second) override { block_.swap(first, second); }
  void copy(std::size_t from, std::size_t to) override { block_.copy(from, to); }
  OpenMesh::BaseProperty* clone() const override {
    return new OpenMesh::PropertyT<V>(static_cast<const OpenMesh::PropertyT<V>&>(*this));
  }

  // .om files cannot store them, which OpenMesh would only print.
  void set_persistent(bool yes) override {
    if (!yes) return;
    throw InputError("the property '" + name() +
                     "' is not stored in .om files; write get_binding() to a .npz file");
  }
  std::string get_storage_name() const override { return "<unknown>"; }
  std::size_t n_elements() const override { return block_.size(); }
  std::size_t element_size() const override { return UnknownSize; }
  std::size_t store(std::ostream&, bool) const override { return 0; }
  std::size_t restore(std::istream&, bool) override { return 0; }

 protected:
  //! Changes the shape of all elements and sets them to 0. If this throws, nothing changes.
  void set_block_shape(std::size_t components, std::size_t width) {
    vector_type block(components, width);
    block.resize(block_.size());
    block_ = std::move(block);
  }

 private:
  vector_type block_;
};

}  // namespace flbc::openmesh
