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

//! An IEEE half precision number.
struct Half {
  std::uint16_t bits;
};

//! A cell with interior corners, which come first.
template <class Scalar, int Dim>
struct Cell {
  Scalar hats[Dim + 1][Dim];   // sqrt(m_s) times the gradients of the corners' hat functions
  std::int32_t rows[Dim + 1];  // of the corners, below num_interior first
};

//! P and the radii are stored as Scalars or halves, depending on the template parameter Stored of
//! the loops.
template <class Scalar, int Dim>
struct Arrays {
  std::size_t stride;
  std::size_t cell_stride;   // of the slice's rows of cell_dual and radius, where column i is at i
  std::size_t num_cells;     // those with interior corners
  std::size_t num_interior;  // m
  // state
  Scalar* extrapolated;   // rows: a = 2 w - W
  Scalar* relaxed;        // m: W
  Scalar* vertex_dual;    // m: S; null without non-negativity
  void* cell_dual;        // num_cells x Dim: P
  Scalar* residual;       // m: right-hand side, then the solution
  double* violation;      // stride: squared violation of z = grad w, if measured
  Scalar* violation_sum;  // stride: the same, of a few cells
  // data
  const Cell<Scalar, Dim>* cells;  // num_cells
  const std::int32_t* cell_index;  // num_cells: index in the mesh, only for flux()
  const void* radius;              // num_cells: phi A / (rho m) in the units of P
  const Scalar* vertex_metric;     // m: k_v
  const Scalar* basis;             // Dim + 1 rows: orthonormal basis Q of [1; c]
  const Scalar* row_target;        // m x (Dim + 1): Q^T w of every row that is feasible, not scaled
  const Scalar* difference;        // rows: w - W, zero on the boundary; for residuals and balancing
  Scalar sigma;
  Scalar relaxation;
  Scalar smoothing;  // theta = epsilon / (rho + epsilon) in [0, 1)
};

//! A slice [begin, end) of control points, multiples of 8.
struct Columns {
  std::size_t begin;
  std::size_t end;
};

//! Sums over the rows of one call.
struct RowSums {
  double change = 0;     //!< squared change of w
  double violation = 0;  //!< squared violation of u = w in the metric, if measured

  RowSums& operator+=(const RowSums& other) {
    change += other.change;
    violation += other.violation;
    return *this;
  }
};

//! The loops for one way of storing P and the radii.
template <class Scalar, int Dim>
struct Loops {
  using State = const Arrays<Scalar, Dim>&;
  using SliceLoop = void (*)(State, Columns);
  using RowLoop = RowSums (*)(State, std::int32_t begin, std::int32_t end);

  //! P = clip(P + G a) relaxed; residual -= G^T P.
  SliceLoop z_step;
  //! The same, also summing the violation of z = grad w; needs `difference`.
  SliceLoop z_step_measured;
  //! After the solve: W relaxed, w = W + the solution projected, a; then the W-step of the next
  //! iteration, S = max(0, S - a) relaxed, and residual = k S.
  RowLoop y_step;
  RowLoop y_step_measured;

  //! residual = -G^T G a, the residual of the Laplace equation.
  SliceLoop harmonic_residual;
  //! a += the solution, projected; residual = 0.
  RowLoop correct;
  //! The W-step alone.
  RowLoop w_step;
  //! P = G a.
  SliceLoop start_cell_dual;
  //! The dual of the objective, scale_s clip(P + G a), at [cell_index x Dim].
  void (*flux)(State, Columns, const Scalar* scale, Scalar* flux);
  //! Sums, per control point, the squared dual |P + G (w - W)|^2 and the squared |G moved|^2 of
  //! rows `moved`.
  void (*balance)(State, Columns, const Scalar* moved, double* dual, double* motion);
  //! Converts values to the storage format, starting at value `first`.
  //! \param count  a multiple of 8
  void (*encode)(const Scalar* from, void* to, std::size_t first, std::size_t count);
  void (*decode)(const void* from, std::size_t first, Scalar* to, std::size_t count);
  std::size_t bytes;  //!< of a stored value
};

//! The loops for one instruction set.
template <class Scalar, int Dim>
struct Kernel {
  Loops<Scalar, Dim> exact;  //!< P and the radii are Scalars
  //! P and the radii are halves, or floats if the instruction set has no halves; for float only.
  Loops<Scalar, Dim> half;
};

}  // namespace flbc::compact

namespace flbc {
FLBC_DECLARE_KERNELS(compact)
}  // namespace flbc
