// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The rows of one element of a wide property.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <string>
#include <type_traits>

#include "flbc/errors.h"

namespace flbc::openmesh {

//! `components` rows of `width` numbers, each padded to `stride` numbers: a reference to the
//! numbers of one element, as those of std::vector<bool> are. A copy of the view refers to the same
//! numbers; assigning to it copies the numbers, as OpenMesh's copy_property() and copy_to() expect.
//! Valid until the property changes its number of elements or its shape. \tparam Scalar  float or
//! double, const for numbers that may only be read
template <class Scalar>
class RowsView {
 public:
  RowsView(Scalar* data, std::size_t components, std::size_t width, std::size_t stride)
      : data_(data), components_(components), width_(width), stride_(stride) {}
  RowsView(const RowsView& rows) = default;

  //! A view for writing converts to one for reading.
  template <class Other, class = std::enable_if_t<std::is_same_v<const Other, Scalar>>>
  RowsView(const RowsView<Other>& rows)
      : RowsView(rows.data(), rows.components(), rows.width(), rows.stride()) {}

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

  //! Distance from one row to the next, a multiple of 8. The numbers from width() on are padding:
  //! leave them zero.
  std::size_t stride() const { return stride_; }

  //! The first row, aligned to 32 (float) or 64 (double) bytes as all rows are.
  Scalar* data() const { return data_; }
  Scalar* row(std::size_t component) const {
    assert(component < components_);
    return data_ + component * stride_;
  }

  //! Number i < width() of a component.
  Scalar& operator()(std::size_t component, std::size_t i) const {
    assert(i < width_);
    return row(component)[i];
  }

  //! Number i of the first component.
  Scalar& operator[](std::size_t i) const { return (*this)(0, i); }

 private:
  void assign(const RowsView<const Scalar>& rows) {
    static_assert(!std::is_const_v<Scalar>, "these numbers may only be read");
    if (rows.components() != components_ || rows.width() != width_) {
      throw InputError("rows of " + std::to_string(rows.components()) + " x " +
                       std::to_string(rows.width()) + " numbers cannot be copied to rows of " +
                       std::to_string(components_) + " x " + std::to_string(width_));
    }
    if (rows.data() != data_) std::copy_n(rows.data(), components_ * stride_, data_);
  }

  Scalar* data_;
  std::size_t components_, width_, stride_;
};

}  // namespace flbc::openmesh
