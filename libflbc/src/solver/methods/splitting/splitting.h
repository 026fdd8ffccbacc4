// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What the splitting on all pairs and the one on an active set share.
#pragma once

#include "base/aligned_array.h"
#include "base/kernel_dispatch.h"
#include "flbc/lbc_problem.h"
#include "solver/methods/splitting/compact_data.h"
#include "solver/methods/splitting/penalty_rule.h"
#include "solver/methods/splitting/row_state.h"
#include "solver/run/iteration.h"

namespace flbc::splitting {

//! Parameters of a splitting.
struct Parameters {
  double penalty = 1;                                  //!< rho > 0
  double relaxation = 1;                               //!< alpha in (0, 2)
  LinearSolver linear_solver = LinearSolver::kDirect;  //!< or kMultigrid; for all pairs
  bool half = false;             //!< stores P and the radii in half precision; for float only
  bool balances = false;         //!< adapts the penalty (penalty_rule.h): early after a cold start
  bool looks = false;            //!< and late
  bool harmonic_cold = false;    //!< a cold start computes accurate harmonic coordinates, instead
                                 //!< of approximately minimizing sum m |grad w|^2 with the existing
                                 //!< factor
  bool paper_residuals = false;  //!< measures r_p and r_d of the 2014 solver
  double part = 1;  //!< factor of the penalty for an active set, where fewer weights move
};

//! The iteration of compact_splitting.h, in its notation, for any arrangement of the pairs of
//! vertices and control points. A subclass arranges rows and cells and solves the linear system.
template <class Scalar, int Dim>
class Splitting : public Iteration<Dim> {
 public:
  //! Starts from weights and duals. Given duals would move the weights, so their effect is
  //! subtracted from W, at the cost of one solve: after every iteration, w = W + the projected
  //! solution.
  void start(const Start<Dim>& start) override;

  //! Step::change refers to the last iteration. Step::violation, if measured, is the violation of z
  //! = grad w before the iteration and of u = w after it, because the w_step of the next iteration
  //! is performed in advance. If the penalty rule is due after it, that w_step waits for adapt().
  Step iterate(int made, int count, bool measure) override;

  //! Changes the penalty if the rule is due, and the storage of duals to single precision once half
  //! precision makes them fluctuate.
  int adapt(const Milestone& at) override;

  void store_in_single();
  bool stores_half() const { return loops_ == &kernel_.half; }

  double penalty() const { return penalty_; }

  void read_weights(Index vertex, double* weights) const override;

  //! The penalty refers to all pairs. Flux densities are zero in cells between boundary vertices.
  Start<Dim> state() const override;

  //! The current p / A of a cell, n x Dim, admissible (start.h).
  Vectors<Dim> flux_density(Index cell) const;

 protected:
  using State = compact::Arrays<Scalar, Dim>;
  using SliceLoop = typename compact::Loops<Scalar, Dim>::SliceLoop;
  using RowLoop = typename compact::Loops<Scalar, Dim>::RowLoop;

  //! The place of a row in the arrays, and its control points, ascending; null for all.
  struct Row {
    std::size_t first;
    Index count;
    const std::uint16_t* items;
  };

  Splitting(const LbcProblem<Dim>& problem, Metric metric, const Parameters& parameters,
            const compact::Kernel<Scalar, Dim>& kernel);

  double sigma() const { return penalty_ * unit_; }

  //! Runs a loop over all cells, then solves the linear system.
  //! \return the squared violation of z = grad w, if the loop measures it
  virtual double solve(SliceLoop loop, double relaxation) = 0;
  virtual compact::RowSums pass_rows(RowLoop loop) = 0;
  //! |P + G (w - W)|^2 of all cells, those at the boundary included, and |G moved|^2; needs w - W.
  virtual BalanceLengths squared_lengths(const AlignedArray<Scalar>& moved) = 0;

  virtual Row row(Index index) const = 0;
  //! P of a cell with interior corners.
  virtual Vectors<Dim> cell_dual(Index cell) const = 0;
  virtual void set_cell_dual(const VectorsAt<Dim>& flux_density) = 0;
  virtual void set_radii() = 0;
  //! Keeps weights and duals of interior rows. The w_step that waited for it must follow.
  virtual void set_penalty(double penalty);
  //! Sets a, as sigma w. \param weights  of an interior vertex
  virtual void set_weights(const VectorsAt<1>& weights);
  //! Adds pairs. \return iterations to make before the run may end
  virtual int extend(const Milestone&) { return 0; }

  const LbcProblem<Dim>& problem_;
  const compact::Kernel<Scalar, Dim>& kernel_;
  const Parameters parameters_;
  const Index n_;
  const Metric metric_;
  const double unit_;  // u
  const compact::Loops<Scalar, Dim>* loops_;
  double penalty_;  // rho
  PenaltyRule rule_;
  // made by the subclass; interior vertices in the order of its linear solver, then the boundary
  compact::CompactData<Scalar, Dim> data_;
  RowState<Scalar> rows_;
  AlignedArray<unsigned char> P_;  // by cells with interior corners, in the storage format

 private:
  template <class Body>
  void for_row(Index vertex, const Body& body) const;
  Eigen::VectorXd vertex_dual_at(Index vertex) const;
  void set_vertex_dual(const VectorsAt<1>& vertex_dual);
  AlignedArray<Scalar> all_rows_of_w() const;
  void measure_paper_residuals(AlignedArray<Scalar> moved, double violation, Step& step);
};

}  // namespace flbc::splitting
