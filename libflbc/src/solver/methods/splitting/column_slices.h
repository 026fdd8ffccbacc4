// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Arrays of cells in slices of control points, one per thread. Each thread then streams contiguous
//! memory instead of reading a part of every row.
#pragma once

#include <cstddef>
#include <vector>

#include "base/aligned_array.h"
#include "linear/panel_cholesky.h"

namespace flbc::splitting {

//! The slices, and the order slice, cell, component, control point of the slice.
class ColumnSlices {
 public:
  //! \param stride  values per row in all slices \param count  maximum number of slices
  ColumnSlices(std::size_t stride, int count) : stride_(stride) {
    for (int k = 0; k < count; ++k) {
      const Slice slice = slice_of(stride, k, count);
      if (slice.begin < slice.end) slices_.push_back(slice);
    }
  }

  std::size_t stride() const { return stride_; }
  std::size_t size() const { return slices_.size(); }
  Slice operator[](std::size_t k) const { return slices_[k]; }

  //! Distance between rows of a slice, in values.
  static std::size_t stride_of(Slice slice) { return slice.end - slice.begin; }

  //! Position of column 0 in the first row of a slice, possibly virtual. \param rows  of the array
  static std::size_t offset_of(Slice slice, std::size_t rows) {
    return rows * slice.begin - slice.begin;
  }

  //! Calls body(begin, width, place) for the columns of every slice, with their position in the
  //! array. \param row  row index: cell * components + component
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
