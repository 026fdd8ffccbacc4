// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The inner loops of the compact splitting (compact_splitting.h) on plain arrays. The same source
//! is compiled for several instruction sets; it does not use Eigen, whose inline functions could
//! clash.
//!
//! Every array is element-major, then component, then `stride` control points contiguous (n, padded
//! with zeros); those of cells may come in slices of control points, see column_slices.h.
//! Units: vertex arrays hold weights times sigma, cell arrays are scaled by sigma sqrt(m), so that
//! gradients need the scaled hat gradients and nothing else. Rows are those of the interior
//! vertices in the order of the linear solver, then those of the boundary.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/kernel_dispatch.h"

namespace flbc::compact {

//! A cell with interior corners, which come first.
template <class Scalar, int Dim>
struct Cell {
  Scalar hats[Dim + 1][Dim];   // sqrt(m_s) times the gradients of the corners' hat functions
  std::int32_t rows[Dim + 1];  // of the corners, below num_interior first
};

template <class Scalar, int Dim>
struct Arrays {
  std::size_t stride;
  std::size_t cell_stride;   // of the slice's rows of cell_dual and radius, where column i is at i
  std::size_t num_cells;     // those with interior corners
  std::size_t num_interior;  // m
  // state
  Scalar* extrapolated;  // rows: a = 2 w - W
  Scalar* relaxed;       // m: W
  Scalar* vertex_dual;   // m: S; null without non-negativity
  Scalar* cell_dual;     // num_cells x Dim: P
  Scalar* residual;      // m: right-hand side, then the solution
  // data
  const Cell<Scalar, Dim>* cells;  // num_cells
  const std::int32_t* cell_index;  // num_cells: index in the mesh, only for flux()
  const Scalar* radius;            // num_cells: phi A / (rho m) in the units of P
  const Scalar* vertex_metric;     // m: k_v
  const Scalar* basis;             // Dim + 1 rows: orthonormal basis Q of [1; c]
  const Scalar* row_target;        // m x (Dim + 1): Q^T w of every row that is feasible, not scaled
  const Scalar* difference;        // rows: w - W, zero on the boundary; for residuals()
  Scalar sigma;
  Scalar relaxation;
  Scalar smoothing;  // theta = epsilon / (rho + epsilon) in [0, 1)
};

//! A slice [begin, end) of control points, multiples of 8.
struct Columns {
  std::size_t begin;
  std::size_t end;
};

//! The loops for one instruction set.
template <class Scalar, int Dim>
struct Kernel {
  using State = const Arrays<Scalar, Dim>&;
  using SliceLoop = void (*)(State, Columns);
  //! \return the squared change of w
  using RowLoop = double (*)(State, std::int32_t begin, std::int32_t end);

  //! P = clip(P + G a) relaxed; residual -= G^T P.
  SliceLoop z_step;
  //! After the solve: W relaxed, w = W + the solution projected, a; then the W-step of the next
  //! iteration, S = max(0, S - a) relaxed, and residual = k S.
  RowLoop y_step;
  //! The W-step alone.
  RowLoop w_step;

  //! residual = -G^T G a, the residual of the Laplace equation.
  SliceLoop harmonic_residual;
  //! a += the solution, projected; residual = 0.
  RowLoop correct;
  //! P = G a.
  SliceLoop start_cell_dual;
  //! The dual of the objective, scale_s clip(P + G a), at [cell_index x Dim].
  void (*flux)(State, Columns, const Scalar* scale, Scalar* flux);
  //! Adds up, per control point, the squared norms of G moved and of z - grad w for the next z, in
  //! the metric.
  void (*residuals)(State, Columns, const Scalar* moved, double* motion, double* violation);
};

}  // namespace flbc::compact

namespace flbc {
FLBC_DECLARE_KERNELS(compact)
}  // namespace flbc
