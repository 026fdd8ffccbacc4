// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Splitting on the weights: the problem (2) of the paper, which keeps weights and gradients as
//! unknowns and solves a global linear system in each iteration.
#pragma once

#include <functional>

#include "base/aligned_array.h"
#include "flbc/lbc_problem.h"
#include "flbc/solver_state.h"
#include "linear/spd_solver.h"
#include "solver/splitting/column_slices.h"
#include "solver/splitting/splitting_data.h"
#include "solver/splitting/splitting_kernel.h"

namespace flbc::splitting {

//! Norms of the residual matrices of ADMM, constraints scaled by the square root of the metric.
struct Residuals {
  double primal;
  double dual;
};

//! Relaxed Douglas-Rachford splitting, which is over-relaxed ADMM with one state y = z + u (scaled
//! dual u) per constraint instead of two. Minimises sum phi A |z| over w with z = grad w, and
//! w >= 0 if the metric says so:
//!
//!     Z-step:  x = grad w,  p = clip(2 x - y) to radius phi A / (rho m),  y += alpha (x - y - p)
//!     W-step:  u = max(0, 2 w - q),  q += alpha (u - w)
//!     Y-step:  solve (sum m grad^T grad + k) delta = Div m (y - x) + k (q - w),
//!              w += delta, rows projected on { sum w = 1, sum w c = x }
//!
//! The projection replaces the null-space parametrisation W = Y M + H of (2): the system matrix
//! acts on columns, M on rows, so Y = K^-1 (R - K H) M^T gives W = K^-1 R M^T M + H, and M^T M = I
//! - Q Q^T. In residual form single precision suffices.
template <class Scalar, int Dim>
class WeightSplitting {
 public:
  //! \param penalty  rho > 0 \param relaxation  alpha in (0, 2) \param linear_solver  kDirect or
  //! kMultigrid \param storage  where the state lives, null for memory of its own
  WeightSplitting(const LbcProblem<Dim>& problem, Metric metric, double penalty, double relaxation,
                  LinearSolver linear_solver = LinearSolver::kDirect,
                  StateStorage* storage = nullptr);

  //! Goes on from the state that the storage holds.
  void resume();

  //! Starts from weights n x V, with y = 0 and q = w: duals zero where the weights are harmonic.
  void start_from_weights(const WeightMatrix& weights);

  //! The same from weights that nearly minimise sum m |grad w|^2, by the iteration's own factor:
  //! one solve without non-negativity; with it solves that each take the weights before for q,
  //! until they no longer move or `steps` are done.
  void start_from_harmonic(int steps);

  //! Starts from weights n x V with all duals zero: z = y = grad w.
  void start_without_duals(const WeightMatrix& weights);

  //! Starts from weights and duals found elsewhere, balanced as an iteration leaves them: the first
  //! Y-step finds nothing to correct.
  //! \param weights  n x V, feasible
  //! \param flux_density  p / A in a cell
  //! \param vertex_dual  q - w, n x V; empty for none
  void start_from_duals(const WeightMatrix& weights, const VectorsAt<Dim>& flux_density,
                        const WeightMatrix& vertex_dual);

  //! \return squared change of all weights
  double iterate();

  //! The same, with the norms of the residuals. The dual one is that of an exact Y-step; a
  //! multigrid cycle in its place gives no less.
  Residuals iterate_with_residuals();

  double penalty() const { return penalty_; }

  double num_residual_components() const;

  //! n x V.
  WeightMatrix weights() const;

  //! q - w, n x V: the dual of the constraint u = w, u >= 0; empty without it.
  WeightMatrix vertex_dual() const;

  //! p = rho m clip(2 x - y): the dual of the total variation, |p_s^i| <= phi A up to rounding.
  CellFieldView<Scalar, Dim> flux();

  //! Writes or reads the state, to the bit. What is read must be of the same problem and penalty.
  template <class Archive>
  void visit(Archive& archive) {
    auto rows = slices_.rows_of(cell_state_);
    archive(weights_, rows, vertex_state_, residual_);
    slices_.set_rows(rows, cell_state_);
  }

  //! Numbers of state held per cell and control point; phi is one more.
  double state_scalars_per_cell() const;

 private:
  //! A step on one slice of the control points.
  using SliceLoop = std::function<void(const Arrays<Scalar, Dim>&, Columns)>;

  using StateRow = Eigen::Map<Eigen::Matrix<Scalar, Eigen::Dynamic, 1>>;

  Arrays<Scalar, Dim> arrays(Slice slice);
  template <class Body>
  void for_cell_row(Index cell, int component, const Body& body);
  void for_slices(const SliceLoop& body);
  double run(const SliceLoop& residual);
  void keep_right_side(Columns columns);
  double change_norm2() const;
  void set_weights(const WeightMatrix& weights);
  void set_states(const VectorsAt<Dim>& flux_density, const WeightMatrix& vertex_dual);
  double correct_weights();
  void take_back_correction();

  const LbcProblem<Dim>& problem_;
  const Kernel<Scalar, Dim>& kernel_;
  const Index n_;
  const std::size_t stride_;
  const ColumnSlices slices_;  // one a thread; cell_state_ and phi are in their order
  const Metric metric_;
  const double penalty_;
  const double relaxation_;
  SpdSolver<Scalar> solver_;
  SplittingData<Scalar, Dim> data_;
  // state
  AlignedArray<Scalar> weights_;
  AlignedArray<Scalar> cell_state_;
  AlignedArray<Scalar> vertex_state_;
  // of the last iteration: right-hand side, then correction of the weights
  AlignedArray<Scalar> residual_;
  AlignedArray<Scalar> right_side_;  // where residuals are asked for
  AlignedArray<Scalar> flux_;
  AlignedArray<double> violation_;
  AlignedArray<Scalar> violation_sum_;
};

}  // namespace flbc::splitting
