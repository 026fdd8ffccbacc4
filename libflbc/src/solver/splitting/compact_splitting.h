// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The splitting on the weights in half the memory: what Method::kValue iterates.
#pragma once

#include <functional>
#include <limits>
#include <type_traits>

#include "base/aligned_array.h"
#include "flbc/lbc_problem.h"
#include "flbc/solver_state.h"
#include "linear/spd_solver.h"
#include "solver/splitting/compact_data.h"
#include "solver/splitting/compact_kernel.h"
#include "solver/splitting/error_estimate.h"

namespace flbc::compact {

//! What an iteration did.
struct Step {
  double change;          //!< squared change of all weights
  double violation = -1;  //!< of the constraints z = grad w and u = w, squared, in the metric; if
                          //!< measured
};

//! Relaxed Douglas-Rachford splitting as in weight_splitting.h, iterate by iterate, but with states
//! that live on vertices as far as they can. Put
//!
//!     y = grad W - P,  q = W + S
//!
//! where W is on vertices like w, with the same values on the boundary. Then, with a = 2 w - W,
//!
//!     Z-step:  P += alpha (clip(P + grad a) - P), clip to radius phi A / (rho m)
//!     W-step:  S += alpha (max(0, S - a) - S)
//!     Y-step:  W += alpha (w - W),  solve (sum m grad^T grad + k) delta = k S - Div m P,
//!              w = W + delta, rows projected on { sum w = 1, sum w c = x }
//!
//! A cell keeps nothing but P, which is a few radii long at most, so that half precision holds it;
//! and a cell without interior corners need not be looked at. With an approximate solver in place
//! of the exact one this is a preconditioned primal-dual iteration with the same limit.
//!
//! In the units of compact_kernel.h vertex arrays hold sigma = rho u times these numbers, P is
//! sigma sqrt(m) times as large, and the penalty appears in sigma alone. \tparam Scalar  of the
//! arithmetic \tparam Stored  of P and the radii: Scalar or Half
template <class Scalar, class Stored, int Dim>
class CompactSplitting {
 public:
  static constexpr bool kStoresHalf = std::is_same_v<Stored, Half>;
  static constexpr bool kAdapts = true;  //!< has iterate_and_adapt()
  static constexpr bool kOnSupports = false;

  //! \param metric  see splitting_data.h
  //! \param penalty  rho > 0
  //! \param relaxation  alpha in (0, 2)
  //! \param linear_solver  kDirect or kMultigrid
  //! \param storage  where the state lives, null for memory of its own
  //! \param kernel  the loops to use; the best ones for this processor unless a test asks for
  //! others
  CompactSplitting(
      const LbcProblem<Dim>& problem, splitting::Metric metric, double penalty, double relaxation,
      LinearSolver linear_solver = LinearSolver::kDirect, StateStorage* storage = nullptr,
      const Kernel<Scalar, Stored, Dim>& kernel = select_kernel<Kernel<Scalar, Stored, Dim>>());

  //! Goes on from where another one is, which loses its state, with P and the radii stored
  //! differently. \param storage  the other one's
  template <class Other>
  CompactSplitting(CompactSplitting<Scalar, Other, Dim>&& other, StateStorage* storage);

  //! Goes on from the state that the storage holds.
  void resume();

  //! Starts from weights n x V, with y = 0 and q = w: duals zero where the weights are harmonic.
  void start_from_weights(const WeightMatrix& weights);

  //! Starts from (nearly) harmonic coordinates, by at most `steps` Richardson steps with the
  //! factor there is.
  void start_from_harmonic(int steps);

  //! Starts from weights and duals that were found elsewhere.
  //! \param weights  of an interior vertex, n numbers, feasible
  //! \param flux_density  p / A of a cell, n x Dim, at most phi long
  //! \param vertex_dual  q - w of an interior vertex, n numbers; null for none
  void start_from_duals(const VectorsAt<1>& weights, const VectorsAt<Dim>& flux_density,
                        const VectorsAt<1>& vertex_dual);

  Step iterate();

  //! The same, for half as much again, and what the constraints lacked: z = grad w before the
  //! iteration, u = w after it.
  Step iterate_measured();

  //! An iteration, after which the penalty is balanced against how far the weights have moved since
  //! the start, and duals are kept: rho becomes ratio rho |grad w - y| / |grad (w - w_start)|,
  //! `largest` at most. Not after start_from_duals().
  Step iterate_and_adapt(double ratio, double largest = std::numeric_limits<double>::infinity());

  double penalty() const { return penalty_; }

  //! w of an interior vertex, padded.
  void read_vertex(Index vertex, Scalar* weights) const;

  //! w of an interior vertex, n numbers.
  Eigen::VectorXd weights_at(Index vertex) const;

  bool has_vertex_dual() const { return vertex_dual_.size() > 0; }

  //! q - w of an interior vertex, n numbers.
  Eigen::VectorXd vertex_dual_at(Index vertex) const;

  //! p / A of a cell as it is at present, n x Dim, at most phi long; zero between boundary
  //! vertices.
  Eigen::Matrix<double, Eigen::Dynamic, Dim> flux_density(Index cell) const;

  //! n x V.
  WeightMatrix weights() const;

  //! p = rho m clip(2 grad w - y): the dual of the total variation, |p_s^i| <= phi A up to
  //! rounding.
  CellFieldView<Scalar, Dim> flux();

  //! Writes or reads the state, to the bit. What is read must be of the same problem, penalty,
  //! Scalar and Stored.
  template <class Archive>
  void visit(Archive& archive) {
    auto rows = slices_.rows_of(cell_dual_);
    archive(extrapolated_, relaxed_, vertex_dual_, rows, residual_);
    archive.empty_or(residual_.size(), start_);
    slices_.set_rows(rows, cell_dual_);
  }

  //! Leaves the state in the storage, complete.
  void finish();

  //! Numbers of state held per cell and control point, in units of the Scalar; phi is one more.
  double state_scalars_per_cell() const;

 private:
  template <class, class, int>
  friend class CompactSplitting;
  using State = Arrays<Scalar, Stored, Dim>;
  using SliceLoop = void (*)(const State&, Columns);
  using RowLoop = RowSums (*)(const State&, std::int32_t, std::int32_t);

  double sigma() const { return penalty_ * unit_; }
  State arrays();
  State in_slice(State state, Slice slice) const;
  void set_weights(const VectorsAt<1>& weights);
  void set_boundary_rows();
  void begin_from_weights();
  void for_slices(const State& state, const std::function<void(const State&, Columns)>& body);
  RowSums run(const State& state, SliceLoop cells, RowLoop rows);
  void adapt_penalty(double ratio, double largest);
  void set_difference();
  void set_residual();
  void set_boundary_flux();

  const LbcProblem<Dim>& problem_;
  const Kernel<Scalar, Stored, Dim>& kernel_;
  const Index n_;
  const std::size_t stride_;
  const splitting::ColumnSlices slices_;  // one a thread; cell_dual_ and radii are in their order
  const splitting::Metric metric_;
  const double unit_;  // u
  double penalty_;
  const double relaxation_;
  SpdSolver<Scalar> solver_;
  CompactData<Scalar, Stored, Dim> data_;
  // state
  AlignedArray<Scalar> extrapolated_;
  AlignedArray<Scalar> relaxed_;
  AlignedArray<Scalar> vertex_dual_;
  AlignedArray<Stored> cell_dual_;
  AlignedArray<Scalar> residual_;
  AlignedArray<Scalar> stored_extrapolated_;  // in the order of the mesh, for the storage
  // what is needed now and then
  AlignedArray<Scalar> start_;
  AlignedArray<Scalar> difference_;
  AlignedArray<Scalar> flux_;
  AlignedArray<double> violation_;
  AlignedArray<Scalar> violation_sum_;
};

}  // namespace flbc::compact
