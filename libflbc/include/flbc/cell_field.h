// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Vectors on cells: gradients of weights and the duals that belong to them.
#pragma once

#include <cstddef>
#include <functional>

#include "flbc/types.h"

namespace flbc {

//! Read access to one vector per cell and control point (gradients, duals), stored cell-major, then
//! by component, then `stride` control points contiguous, of which the first n count.
template <class Scalar, int Dim>
struct CellFieldView {
  const Scalar* data;  //!< of the first cell
  std::size_t stride;  //!< numbers from one component to the next, >= n
  Index n;             //!< number of control points

  //! Dim x n, on one cell, in double precision.
  Eigen::Matrix<double, Dim, Eigen::Dynamic> cell(Index s) const {
    using Rows = Eigen::Matrix<Scalar, Dim, Eigen::Dynamic, Eigen::RowMajor>;
    return Eigen::Map<const Rows, 0, Eigen::OuterStride<>>(
               data + static_cast<std::size_t>(s) * Dim * stride, Dim, n,
               Eigen::OuterStride<>(static_cast<Eigen::Index>(stride)))
        .template cast<double>();
  }
};

//! One vector per control point on a cell or facet, n x Dim, computed on demand.
template <int Dim>
using VectorsAt = std::function<Eigen::Matrix<double, Eigen::Dynamic, Dim>(Index)>;

}  // namespace flbc
