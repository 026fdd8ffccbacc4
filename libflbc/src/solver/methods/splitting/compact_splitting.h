// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Splitting on the weights: Method::kValue, and with another metric and start Method::kLbc2014.
#pragma once

#include <functional>
#include <utility>

#include "base/aligned_array.h"
#include "base/kernel_dispatch.h"
#include "flbc/lbc_problem.h"
#include "linear/spd_solver.h"
#include "solver/methods/splitting/compact_data.h"
#include "solver/methods/splitting/penalty_rule.h"
#include "solver/methods/splitting/row_state.h"
#include "solver/run/iteration.h"

namespace flbc::compact {

//! Parameters of a splitting.
struct Parameters {
  double penalty = 1;                                  //!< rho > 0
  double relaxation = 1;                               //!< alpha in (0, 2)
  LinearSolver linear_solver = LinearSolver::kDirect;  //!< or kMultigrid
  bool half = false;             //!< stores P and the radii in half precision; for float only
  bool balances = false;         //!< adapts the penalty (penalty_rule.h): early after a cold start
  bool looks = false;            //!< and late
  bool harmonic_cold = false;    //!< a cold start computes accurate harmonic coordinates, instead
                                 //!< of approximately minimizing sum m |grad w|^2 with the existing
                                 //!< factor
  bool paper_residuals = false;  //!< measures r_p and r_d of the 2014 solver
};

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
//! A cell stores only P, which is at most a few radii long and fits half precision. (With epsilon
//! it may be longer: theta times a gradient.) The metric is m = A if epsilon > 0. Cells without
//! interior corners are omitted, because they do not affect the weights. With an approximate linear
//! solver, this is a preconditioned primal-dual iteration with the same limit.
//!
//! In the units of compact_kernel.h vertex arrays hold sigma = rho u times these numbers, P is
//! sigma sqrt(m) times as large, and the penalty appears in sigma alone.
//! \tparam Scalar  of the arithmetic
template <class Scalar, int Dim>
class CompactSplitting final : public Iteration<Dim> {
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

  //! Step::change refers to the last iteration. Step::violation, if measured, is the violation of z
  //! = grad w before the iteration and of u = w after it, because the w_step of the next iteration
  //! is performed in advance. If the penalty rule is due after it, that w_step waits for adapt().
  Step iterate(int made, int count, bool measure) override;

  //! Changes the penalty if the rule is due, and the storage of duals to single precision once half
  //! precision makes them fluctuate.
  int adapt(const Milestone& at) override;

  //! Changes rho, keeping weights and duals.
  void set_penalty(double penalty);
  void store_in_single();
  bool stores_half() const { return loops_ == &kernel_.half; }

  double penalty() const { return penalty_; }

  Weights weights() const override { return {all_weights(), {}}; }

  //! n x V.
  WeightMatrix all_weights() const;

  void read_weights(Index vertex, double* weights) const override;

  //! Flux densities of cells between boundary vertices are zero.
  Start<Dim> state() const override;

  bool has_vertex_dual() const { return rows_.S.size() > 0; }
  //! q - w of an interior vertex, n numbers.
  Eigen::VectorXd vertex_dual_at(Index vertex) const;

  //! The current p / A of a cell, n x Dim, admissible (start.h).
  Eigen::Matrix<double, Eigen::Dynamic, Dim> flux_density(Index cell) const;

  Certificate certify(const WeightMatrix& weights) const override;

  //! Calls use(p) with p = rho m times the new P: the dual of the objective, without smoothness
  //! |p_s^i| <= phi A up to rounding.
  void with_flux(const std::function<void(const CellFieldView<Scalar, Dim>&)>& use) const;

  void describe(SolveReport& report) const override;

 private:
  using State = Arrays<Scalar, Dim>;
  using SliceLoop = typename Loops<Scalar, Dim>::SliceLoop;
  using RowLoop = typename Loops<Scalar, Dim>::RowLoop;

  double sigma() const { return penalty_ * unit_; }
  splitting::BalanceLengths squared_lengths(const AlignedArray<Scalar>& moved);
  State arrays();
  void set_weights(const VectorsAt<1>& weights);
  void set_boundary_rows();
  void begin_from_weights();
  void start_from_duals(const Start<Dim>& start);
  void set_cell_dual(const VectorsAt<Dim>& flux_density);
  void set_vertex_dual(const VectorsAt<1>& vertex_dual);
  void for_slices(const State& state, const std::function<void(const State&, Columns)>& body) const;
  RowSums pass(const State& state, SliceLoop cells, RowLoop rows);
  AlignedArray<Scalar> all_rows_of_w() const;
  void measure_paper_residuals(AlignedArray<Scalar> moved, double violation, Step& step);
  splitting::BalanceLengths lengths_since_start();

  const LbcProblem<Dim>& problem_;
  const Kernel<Scalar, Dim>& kernel_;
  const Loops<Scalar, Dim>* loops_;
  const Parameters parameters_;
  const Index n_;
  const std::size_t stride_;
  const splitting::ColumnSlices slices_;  // one per thread; P and radii are in their order
  const splitting::Metric metric_;
  const double unit_;  // u
  double penalty_;     // rho
  SpdSolver<Scalar> solver_;
  CompactData<Scalar, Dim> data_;
  splitting::PenaltyRule rule_;
  // state: interior vertices in the order of the solver, then the boundary
  splitting::RowState<Scalar> rows_;
  AlignedArray<unsigned char> P_;  // by cells with interior corners
  // temporary arrays
  AlignedArray<double> violation_;
  AlignedArray<Scalar> violation_sum_;
};

}  // namespace flbc::compact
