// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The inner loops of the splitting on the weights, on plain arrays. The same source is compiled
//! for several instruction sets; there is no Eigen here, whose inline functions could clash.
//!
//! Every array is element-major, then component, then `stride` control points contiguous (n padded
//! to a multiple of 8; the padding stays zero); those of cells may come in slices of control
//! points, see column_slices.h. Except for the projection of rows, control points do not see each
//! other: a thread takes a slice of them through all cells.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/kernel_dispatch.h"

namespace flbc::splitting {

template <class Scalar, int Dim>
struct Arrays {
  std::size_t stride;
  std::size_t cell_stride;   // of the slice's rows of cell_state and phi, where column i is at i
  std::size_t num_cells;     // F
  std::size_t num_interior;  // m
  // state
  Scalar* weights;       // V: w, in the order of the mesh
  Scalar* cell_state;    // F x Dim: y
  Scalar* vertex_state;  // V: q, in the order of the mesh; null without non-negativity
  // m + 1: right-hand side, solution, and last the change of w; the last row is for the boundary
  Scalar* residual;
  double* violation;      // stride: squared constraint violation per control point, if measured
  Scalar* violation_sum;  // stride: the same, of a few elements
  // data
  const std::int32_t* cells;      // F x (Dim + 1) vertices
  const std::int32_t* cell_rows;  // F x (Dim + 1) rows of `residual`
  const std::int32_t* vertices;   // m: the vertex of each row
  const Scalar* hat_gradients;    // F x Dim x Dim: of the corners 1 .. Dim
  const Scalar* cell_metric;      // F: m_s
  const Scalar* vertex_metric;    // m: k_v
  const Scalar* phi;              // F
  const Scalar* radius_scale;     // F: A_s / (rho m_s)
  const Scalar* basis;            // (Dim + 1): orthonormal basis Q of [1; c]
  const Scalar* row_target;       // m x (Dim + 1): Q^T w of every row that is feasible
  Scalar largest_weight;
  Scalar relaxation;
};

//! A slice [begin, end) of control points, multiples of 8.
struct Columns {
  std::size_t begin;
  std::size_t end;
};

//! The loops for one instruction set, in the order of an iteration.
template <class Scalar, int Dim>
struct Kernel {
  using SliceLoop = void (*)(const Arrays<Scalar, Dim>&, Columns);
  using RowLoop = double (*)(const Arrays<Scalar, Dim>&, std::int32_t begin, std::int32_t end);
  using FluxLoop = void (*)(const Arrays<Scalar, Dim>&, Columns, const Scalar* scale, Scalar* flux);
  //! W-step with its dual step; writes the residual anew.
  SliceLoop w_step;
  //! Z-step with its dual step; adds to the residual.
  SliceLoop z_step;
  //! w_step and z_step, which also add up the violation of the constraints.
  SliceLoop w_step_measured;
  SliceLoop z_step_measured;
  //! Y-step after the solve: adds the correction, projects rows. \return squared change of weights
  RowLoop y_step;
  //! The dual of the total variation, scale_s clip(2 x - y), F x Dim rows.
  FluxLoop flux;
};

}  // namespace flbc::splitting

namespace flbc {
FLBC_DECLARE_KERNEL(splitting, float, 2)
FLBC_DECLARE_KERNEL(splitting, float, 3)
FLBC_DECLARE_KERNEL(splitting, double, 2)
FLBC_DECLARE_KERNEL(splitting, double, 3)
}  // namespace flbc
