// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Arrays of cells by slices of control points, one per thread. Each thread then streams memory of
//! its own; of rows of all control points it would read a part of every line.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/aligned_array.h"
#include "linear/panel_cholesky.h"

namespace flbc::splitting {

//! The slices, and the order slice, cell, component, control point of the slice.
class ColumnSlices {
 public:
  //! \param stride  numbers of a row in all slices \param count  of slices at most
  ColumnSlices(std::size_t stride, int count) : stride_(stride) {
    for (int k = 0; k < count; ++k) {
      const Slice slice = slice_of(stride, k, count);
      if (slice.begin < slice.end) slices_.push_back(slice);
    }
  }

  std::size_t stride() const { return stride_; }
  std::size_t size() const { return slices_.size(); }
  Slice operator[](std::size_t k) const { return slices_[k]; }

  //! Numbers from one row of a slice to the next.
  static std::size_t stride_of(Slice slice) { return slice.end - slice.begin; }

  //! Where column 0 of a slice's first row is, or would be. \param rows  of the array
  static std::size_t offset_of(Slice slice, std::size_t rows) {
    return rows * slice.begin - slice.begin;
  }

  //! Calls body(begin, width, place) for the columns of every slice, and where in the array they
  //! stand. \param row  of so many rows: cell times components, and the component
  template <class Body>
  void for_each(std::size_t row, std::size_t rows, const Body& body) const {
    for (const Slice slice : slices_) {
      body(slice.begin, slice.end - slice.begin,
           offset_of(slice, rows) + row * stride_of(slice) + slice.begin);
    }
  }

 private:
  std::size_t stride_;
  std::vector<Slice> slices_;
};

}  // namespace flbc::splitting
