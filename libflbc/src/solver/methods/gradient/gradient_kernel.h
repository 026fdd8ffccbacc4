// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The inner loops of the gradient ADMM on plain arrays. The same source is compiled for several
//! instruction sets; it must not use headers whose inline functions could clash, such as Eigen.
//!
//! Every array is element-major, then component, then `stride` control points contiguous (n, padded
//! with zeros).
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/kernel_dispatch.h"
#include "base/padded_rows.h"

namespace flbc::gradient {

constexpr int kLanes = kRowLanes;

//! State and data of the iteration. Scaled duals u = lambda / mu in the compact form: the dual of a
//! facet's constraint is one tangential vector (Dim - 1 components), positive on its first side.
template <class Scalar, int Dim>
struct Arrays {
  std::size_t stride;
  // state
  Scalar* gradient;      // F x Dim: G
  Scalar* extrapolated;  // F x Dim: 2 G - G before
  Scalar* tv_dual;       // F x Dim: dual of Z = G
  Scalar* period_dual;   // P: duals of the period constraints (boundary_periods.h), whole domain
  Scalar* facet_dual;    // E x (Dim - 1): duals of X = G S_X on the boundary, of Y = G S_Y inside
  // squared changes of the duals per element, counting both sides of a facet, summed over control
  // points
  double* cell_change;   // F
  double* facet_change;  // E
  // data
  const Scalar* radius;                // F: phi A / mu
  const Scalar* smoothing;             // F, no control points: epsilon A / (mu + epsilon A)
  const Scalar* boundary_slope;        // #boundary facets x (Dim - 1): h, tangential derivatives
  const Scalar* tangents;              // E x (Dim - 1) x Dim, orthonormal, no control points
  const std::int32_t* sides;           // E x 2 cells, second -1 on the boundary
  const std::int32_t* boundary_index;  // E: index among the boundary facets
  const std::int32_t* cell_facets;     // F x (Dim + 1)
  const Scalar* period_fields;         // P x F x Dim, no control points
  std::size_t num_periods;             // P: boundary components - 1
  std::size_t num_cells;               // F
  Scalar inverse_M;                    // 1 / M of (11), for the mean of the M copies of a gradient
  const Scalar* basis;                 // Dim + 1 rows: orthonormal basis Q of [1; c]
  const Scalar* target;  // Dim x (Dim + 1) numbers: Q^T g for every g that satisfies (8)
  Scalar relaxation;
};

//! Sums over the elements of one call, for the residuals.
struct Change {
  double dual = 0;      //!< squared change of all duals (both sides of a facet count)
  double gradient = 0;  //!< squared change of G
  double lead = 0;      //!< squared difference of the new G from the extrapolated old one

  // Always inlined, so the linker cannot mix copies for different instruction sets.
  [[gnu::always_inline]] inline Change& operator+=(const Change& other) {
    dual += other.dual;
    gradient += other.gradient;
    lead += other.lead;
    return *this;
  }
};

//! Location of the extrapolated gradient of a cell during a pass: slot `place` of the pass or, if
//! negative, cell ~place of the whole array.
using Place = std::int32_t;

//! A facet whose cells have completed the G-step. On the boundary both places refer to the same
//! cell.
struct Closing {
  std::int32_t facet;
  Place first;
  Place second;
};

//! A cell, and the number of facets whose last cell it is.
struct Visit {
  std::int32_t cell;
  Place place;
  std::int32_t num_closings;
};

//! The path of a pass through its part of the mesh (cell_pass.h).
struct PassPath {
  const Visit* visits;
  std::size_t num_visits;
  const Closing* closings;  // in the order of the visits
};

//! The loops for one instruction set. A step is bit-identical in all loops.
template <class Scalar, int Dim>
struct Kernel {
  using State = const Arrays<Scalar, Dim>&;

  //! X- and Y-step with their dual step, for facets begin .. end-1.
  void (*xy_step)(State, std::int32_t begin, std::int32_t end);

  //! The same for given facets; records their changes only if `noted`.
  void (*listed_xy_step)(State, const std::int32_t* facets, std::size_t count, bool noted);

  //! Z-step with its dual step, for cells begin .. end-1.
  void (*z_step)(State, std::int32_t begin, std::int32_t end);

  //! G-step, for cells begin .. end-1. \return changes of the gradients, and their leads
  Change (*g_step)(State, std::int32_t begin, std::int32_t end);

  //! G-step, and the next iteration's Z-, X- and Y-step. `slots` stores extrapolated gradients,
  //! num_slots x Dim.
  void (*pass)(State, const PassPath& path, Scalar* slots);

  //! The same, keeping all extrapolated gradients in their array and recording changes of duals.
  void (*pass_and_note)(State, const PassPath& path, Scalar* unused);
};

}  // namespace flbc::gradient

namespace flbc {
FLBC_DECLARE_KERNELS(gradient)
}  // namespace flbc
