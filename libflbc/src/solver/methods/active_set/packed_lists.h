// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Rows of different lengths in one array, and their constraints.
#pragma once

#include <vector>

#include "base/aligned_array.h"
#include "flbc/types.h"
#include "solver/methods/active_set/active_kernel.h"
#include "solver/methods/active_set/active_lists.h"

namespace flbc::active_set {

//! Rows that a thread takes at a time.
constexpr Index kRowBlock = 64;

//! The arrays that Lists point to.
struct PackedLists {
  std::vector<std::size_t> starts{0};
  std::vector<std::int32_t> counts;
  std::vector<ControlPoint> items;

  Lists view() const { return {starts.data(), counts.data(), items.data()}; }
  Index num_rows() const { return static_cast<Index>(counts.size()); }
  //! Numbers of all rows, padding included.
  std::size_t size() const { return starts.back(); }

  //! Adds a row. \param n  what stands in the padding
  void append(const ControlPoint* first, const ControlPoint* last, ControlPoint n);
};

//! Orthonormal bases of [1; c] on the control points of every row: Dim + 1 rows of its length each.
//! Where its control points lie in a plane or are too few, some are zero.
//! \param points  Dim x rows, or without columns \param targets  Q^T w of all w on the list that
//! sum to one and reproduce the row's point, Dim + 1 numbers per row; null without points
template <class Scalar, int Dim>
AlignedArray<Scalar> row_bases(const PackedLists& lists, const PointList<Dim>& control_points,
                               const PointList<Dim>& points, std::vector<Scalar>* targets);

}  // namespace flbc::active_set
