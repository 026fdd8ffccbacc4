// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The inner loops of the gradient ADMM on plain arrays. The same source is compiled for several
//! instruction sets; nothing here may depend on headers whose inline functions could then clash, so
//! there is no Eigen.
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
  // squared changes of the duals per element, both sides of a facet counted, no control points
  double* cell_change;   // F
  double* facet_change;  // E
  // data
  const Scalar* radius;                // F: phi A / mu
  const Scalar* boundary_slope;        // #boundary facets x (Dim - 1): h, tangential derivatives
  const Scalar* tangents;              // E x (Dim - 1) x Dim, orthonormal, no control points
  const std::int32_t* sides;           // E x 2 cells, second -1 on the boundary
  const std::int32_t* boundary_index;  // E: place among the boundary facets
  const std::int32_t* cell_facets;     // F x (Dim + 1)
  const Scalar* period_fields;         // P x F x Dim, no control points
  std::size_t num_periods;             // P: boundary components - 1
  std::size_t num_cells;               // F
  Scalar inverse_M;                    // 1 / M, see (11): the mean of a gradient's M copies
  const Scalar* basis;                 // (Dim + 1): orthonormal basis Q of [1; c]
  const Scalar* target;  // Dim x (Dim + 1) numbers: Q^T g for every g that satisfies (8)
  Scalar relaxation;
};

//! Sums over the elements of one call, for the residuals.
struct Change {
  double dual = 0;      //!< squared change of all duals (both sides of a facet count)
  double gradient = 0;  //!< squared change of G
  double lead = 0;      //!< squared difference of the new G from the extrapolated old one

  // Always inlined, so that no instruction set's copy can be linked into code for another.
  [[gnu::always_inline]] inline Change& operator+=(const Change& other) {
    dual += other.dual;
    gradient += other.gradient;
    lead += other.lead;
    return *this;
  }
};

//! Where a cell's extrapolated gradient is during a sweep: slot `place` of the sweep's slots, or,
//! if negative, cell ~place of the whole array.
using Place = std::int32_t;

//! A facet on whose cells the G-step has been made. On the boundary both places are the one cell's.
struct Closing {
  std::int32_t facet;
  Place first;
  Place second;
};

//! A cell, and how many facets it is the last cell of.
struct Visit {
  std::int32_t cell;
  Place place;
  std::int32_t num_closings;
};

//! The way of a sweep through its part of the mesh (sweep.h).
struct SweepPath {
  const Visit* visits;
  std::size_t num_visits;
  const Closing* closings;  // in the order of the visits
};

//! The loops for one instruction set. A step gives the same bits whichever loop it is part of.
template <class Scalar, int Dim>
struct Kernel {
  using State = const Arrays<Scalar, Dim>&;

  //! X- and Y-step with their dual step, for facets begin .. end-1.
  void (*xy_step)(State, std::int32_t begin, std::int32_t end);

  //! The same for some facets; their changes are noted only if `noted`.
  void (*listed_xy_step)(State, const std::int32_t* facets, std::size_t count, bool noted);

  //! Z-step with its dual step, for cells begin .. end-1.
  void (*z_step)(State, std::int32_t begin, std::int32_t end);

  //! G-step, for cells begin .. end-1. \return changes of the gradients and their leads
  Change (*g_step)(State, std::int32_t begin, std::int32_t end);

  //! G-step, and the next iteration's Z-, X- and Y-step. `slots` holds extrapolated gradients
  //! meanwhile, num_slots x Dim.
  void (*sweep)(State, const SweepPath& path, Scalar* slots);

  //! The same, with all extrapolated gradients kept in their array and changes of duals noted.
  void (*sweep_and_note)(State, const SweepPath& path, Scalar* unused);
};

}  // namespace flbc::gradient

namespace flbc {
FLBC_DECLARE_KERNELS(gradient)
}  // namespace flbc
