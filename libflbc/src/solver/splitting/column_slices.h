// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Arrays of cells by slices of control points, one a thread: each thread then reads memory of its
//! own, where of rows of all control points it would read a part of every line.
#pragma once

#include <cstddef>
#include <vector>

#include "linear/panel_cholesky.h"

namespace flbc::splitting {

//! The order slice, cell, component, control point of the slice.
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

  //! Calls body(begin, width, place) for the columns of every slice, and where in the array they
  //! stand. \param row  of so many rows: cell times components, and the component
  template <class Body>
  void for_each(std::size_t row, std::size_t rows, const Body& body) const {
    for (const Slice& slice : slices_) {
      const std::size_t width = slice.end - slice.begin;
      body(slice.begin, width, rows * slice.begin + row * width);
    }
  }

 private:
  std::size_t stride_;
  std::vector<Slice> slices_;
};

}  // namespace flbc::splitting
