// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A property of OpenMesh meshes whose elements are rows of values, stored in one block.
//!
//!     OpenMesh::VProp<flbc::openmesh::Wide<double>> weights(mesh, "flbc:weights");
//!     mesh.property(weights.getRawProperty()).set_shape(1, cage_size);
//!     weights[vertex][i] = 0.5;
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <new>
#include <string>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "flbc/errors.h"
#include "flbc/openmesh/block_property.h"

namespace flbc::openmesh {

//! A view of the values of one element: `components` rows of `width` values. A copy of the view
//! refers to the same values. Assigning to it copies the values, as copy_property() and copy_to()
//! of OpenMesh expect. Valid until the property changes its number of elements or its shape.
//! \tparam Scalar  type of the values, const for read-only views
template <class Scalar>
class RowsView {
 public:
  RowsView(Scalar* data, std::size_t components, std::size_t width)
      : data_(data), components_(components), width_(width) {}
  RowsView(const RowsView& rows) = default;

  //! A writable view converts to a read-only view.
  template <class Other, class = std::enable_if_t<std::is_same_v<const Other, Scalar>>>
  RowsView(const RowsView<Other>& rows) : RowsView(rows.data(), rows.components(), rows.width()) {}

  //! Copies the numbers. \throws InputError if the views differ in shape
  RowsView& operator=(const RowsView& rows) {
    if (this != &rows) assign(rows);
    return *this;
  }
  template <class Other>
  RowsView& operator=(const RowsView<Other>& rows) {
    assign(rows);
    return *this;
  }

  std::size_t components() const { return components_; }
  std::size_t width() const { return width_; }
  Scalar* data() const { return data_; }
  Scalar* row(std::size_t component) const { return data_ + component * width_; }

  //! Value i < width() of a component.
  Scalar& operator()(std::size_t component, std::size_t i) const {
    assert(component < components_ && i < width_);
    return row(component)[i];
  }

  //! Value i of the first component.
  Scalar& operator[](std::size_t i) const { return (*this)(0, i); }

  //! The values as an Eigen matrix, components x width.
  auto matrix() const {
    using Matrix =
        Eigen::Matrix<std::remove_const_t<Scalar>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    using Mapped = std::conditional_t<std::is_const_v<Scalar>, const Matrix, Matrix>;
    return Eigen::Map<Mapped>(data_, static_cast<Eigen::Index>(components_),
                              static_cast<Eigen::Index>(width_));
  }

 private:
  void assign(const RowsView<const Scalar>& rows) {
    static_assert(!std::is_const_v<Scalar>, "these numbers may only be read");
    if (rows.components() != components_ || rows.width() != width_) {
      throw InputError("rows of " + std::to_string(rows.components()) + " x " +
                       std::to_string(rows.width()) + " numbers cannot be copied to rows of " +
                       std::to_string(components_) + " x " + std::to_string(width_));
    }
    if (rows.data() != data_) std::copy_n(rows.data(), components_ * width_, data_);
  }

  Scalar* data_;
  std::size_t components_, width_;
};

//! Like a std::vector whose elements are `components` rows of `width` values each. Value i of
//! component c of element e is at data()[(e * components() + c) * width() + i]. New values are 0.
template <class Scalar>
class RowBlock {
 public:
  RowBlock() = default;
  //! No elements yet. \throws std::bad_alloc if one element would exceed the address space
  RowBlock(std::size_t components, std::size_t width) : components_(components), width_(width) {
    if (width > 0 && components > kMostNumbers / width) throw std::bad_alloc();
  }

  std::size_t size() const { return size_; }
  std::size_t components() const { return components_; }
  std::size_t width() const { return width_; }
  std::size_t element_size() const { return components_ * width_; }  //!< numbers per element
  Scalar* data() { return numbers_.data(); }
  const Scalar* data() const { return numbers_.data(); }

  RowsView<Scalar> operator[](std::size_t e) {
    return {data() + e * element_size(), components_, width_};
  }
  RowsView<const Scalar> operator[](std::size_t e) const {
    return {data() + e * element_size(), components_, width_};
  }

  void reserve(std::size_t elements) { numbers_.reserve(numbers_of(elements)); }
  void resize(std::size_t elements) {
    numbers_.resize(numbers_of(elements));
    size_ = elements;
  }
  //! Keeps the shape, frees the memory.
  void clear() { *this = RowBlock(components_, width_); }

  //! Takes the values of all elements. \param numbers  element_size() per element
  void assign(std::size_t elements, std::vector<Scalar> numbers) {
    assert(numbers.size() == numbers_of(elements));
    numbers_ = std::move(numbers);
    size_ = elements;
  }

  void swap(std::size_t first, std::size_t second) {
    if (first == second) return;
    Scalar* const numbers = data() + first * element_size();
    std::swap_ranges(numbers, numbers + element_size(), data() + second * element_size());
  }
  void copy(std::size_t from, std::size_t to) {
    if (from != to) std::copy_n((*this)[from].data(), element_size(), (*this)[to].data());
  }

 private:
  static constexpr std::size_t kMostNumbers =
      (std::numeric_limits<std::ptrdiff_t>::max)() / sizeof(Scalar);

  std::size_t numbers_of(std::size_t elements) const {
    if (element_size() > 0 && elements > kMostNumbers / element_size()) throw std::bad_alloc();
    return elements * element_size();
  }

  std::vector<Scalar> numbers_;
  std::size_t size_ = 0;
  std::size_t components_ = 1, width_ = 0;
};

//! Value type of a wide property: an element is a block of rows of Scalars, accessed as RowsView.
template <class Scalar>
struct Wide {
  static_assert(std::is_same_v<Scalar, float> || std::is_same_v<Scalar, double>,
                "wide properties hold float or double");
  using Block = RowBlock<Scalar>;
};

}  // namespace flbc::openmesh

namespace OpenMesh {

//! The type that mesh.property(handle, element) returns.
template <class Scalar>
struct BasePropHandleT<flbc::openmesh::Wide<Scalar>>
    : BaseHandle, flbc::openmesh::BlockTypes<flbc::openmesh::Wide<Scalar>> {
  explicit BasePropHandleT(int index = -1) : BaseHandle(index) {}
};

//! Every element has `components` rows of `width` values, initially 1 and 0; set_shape() changes
//! this.
template <class Scalar>
class PropertyT<flbc::openmesh::Wide<Scalar>>
    : public flbc::openmesh::BlockProperty<flbc::openmesh::Wide<Scalar>> {
 public:
  using flbc::openmesh::BlockProperty<flbc::openmesh::Wide<Scalar>>::BlockProperty;

  //! Changes the shape of all elements and sets them to 0.
  //! \throws std::bad_alloc, and then nothing has changed
  void set_shape(std::size_t components, std::size_t width) {
    this->set_block_shape(components, width);
  }
  std::size_t components() const { return this->data_vector().components(); }
  std::size_t width() const { return this->data_vector().width(); }

  //! Value i of component c of element e is at [(e * components() + c) * width() + i].
  Scalar* data() { return this->data_vector().data(); }
  const Scalar* data() const { return this->data_vector().data(); }
  //! Size of all elements.
  std::size_t bytes() const {
    return this->n_elements() * this->data_vector().element_size() * sizeof(Scalar);
  }
};

}  // namespace OpenMesh
