// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Splitting on the weights: Method::kValue, and with another metric and start Method::kLbc2014.
#pragma once

#include "base/aligned_array.h"
#include "linear/spd_solver.h"
#include "solver/methods/splitting/splitting.h"

namespace flbc::compact {

using splitting::Parameters;

//! The ADMM on problem (2) of the paper, as over-relaxed Douglas-Rachford splitting. It minimizes
//! sum A (phi |z| + epsilon / 2 |z|^2) over weights with Z = G W + E and U = W, U >= 0 if the
//! metric has vertex weights. (The paper writes W for U, and Y M + H for the weights W.) An
//! iteration, with scaled duals D, and the loop of compact_kernel.h that performs each line:
//!
//!     Z-update   Z = shrink(G W + E - D_Z)                              z_step
//!     W-update   U = max(0, W - D_U)                                    w_step
//!     duals      D_Z += Z - (G W + E),  D_U += U - W, relaxed           z_step, w_step
//!     Y-update   right-hand side, from Z, U, and their duals            z_step (-G^T), w_step (k
//!     S)
//!                solve (G^T m G + k) delta = right-hand side            solve_slice
//!                W = projection of (W + delta) on { sum w = 1, sum w c = x }   y_step
//!
//! The loops fuse lines and keep two combinations of the variables:
//! P = G W' - (Z + D_Z) and S = U + D_U - W', where W' follows W by W' += alpha (W - W') and has
//! the same values on the boundary. Below, W is this W' and w the weights. With a = 2 w - W,
//!
//!     z_step:  P += alpha (theta v + (1 - theta) clip(v) - P), v = P + grad a,
//!              clip to radius phi A / (rho m), theta = epsilon / (rho + epsilon)
//!     w_step:  S += alpha (max(0, S - a) - S)
//!     solve:   (sum m grad^T grad + k) delta = k S - Div m P
//!     y_step:  W += alpha (w - W), w = W + delta, rows projected on { sum w = 1, sum w c = x }
//!
//! tests/support/textbook_lbc2014.h has the same iterates, with W, Z, Y, M, H, and all duals.
//!
//! The projection replaces the null-space parametrization W = Y M + H of (2): the system matrix
//! acts on columns and M on rows. So Y = K^-1 (R - K H) M^T gives W = K^-1 R M^T M + H, where
//! M^T M = I - Q Q^T.
//!
//! A cell stores only P. The metric is m = A if epsilon > 0. Cells without
//! interior corners are omitted, because they do not affect the weights. With an approximate linear
//! solver, this is a preconditioned primal-dual iteration with the same limit.
//!
//! In the units of compact_kernel.h vertex arrays hold sigma = rho u times these numbers, P is
//! sigma sqrt(m) times as large, and the penalty appears in sigma alone.
//! \tparam Scalar  of the arithmetic
template <class Scalar, int Dim>
class CompactSplitting final : public splitting::Splitting<Scalar, Dim> {
 public:
  //! \param metric  see metric.h
  //! \param kernel  the loops to use; default: the best for this processor
  CompactSplitting(const LbcProblem<Dim>& problem, splitting::Metric metric,
                   const Parameters& parameters,
                   const Kernel<Scalar, Dim>& kernel = select_kernel<Kernel<Scalar, Dim>>());

  //! Cold: from (nearly) harmonic coordinates.
  void start(const Start<Dim>& start) override;

  //! Starts from weights n x V, with y = 0 and q = w: duals zero where the weights are harmonic.
  void start_from_weights(const WeightMatrix& weights);

  //! Starts from (nearly) minimal sum m |grad w|^2, by at most `steps` Richardson steps with the
  //! existing factor.
  void start_from_harmonic(int steps);

  Weights weights() const override { return {all_weights(), {}}; }

  //! n x V.
  WeightMatrix all_weights() const;

  Certificate certify(const WeightMatrix& weights, Proof* proof) const override;

  //! p = rho m times the new P: the dual of the objective, without smoothness |p_s^i| <= phi A up
  //! to rounding. F x Dim rows of padded(n) numbers.
  AlignedArray<Scalar> flux() const;

  void describe(SolveReport& report) const override;

 private:
  using Base = splitting::Splitting<Scalar, Dim>;
  using Base::data_, Base::kernel_, Base::metric_, Base::n_, Base::P_, Base::parameters_,
      Base::problem_, Base::rows_, Base::sigma, Base::unit_;
  using typename Base::Row, typename Base::RowLoop, typename Base::SliceLoop, typename Base::State;

  State arrays();
  void begin_from_weights();
  template <class Body>
  void for_slices(const State& state, const Body& body) const;
  void solve(SliceLoop loop, double relaxation) override;
  double pass_rows(RowLoop loop) override;
  splitting::CellResiduals cell_residuals(const AlignedArray<Scalar>& moved) override;
  Row row(Index index) const override { return {index * stride_, n_, nullptr}; }
  Vectors<Dim> cell_dual(Index cell) const override;
  void set_cell_dual(const VectorsAt<Dim>& flux_density) override;
  void set_radii();

  const std::size_t stride_;
  const splitting::ColumnSlices slices_;  // one per thread; P and radii are in their order
  SpdSolver<Scalar> solver_;
};

}  // namespace flbc::compact
