// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What the splitting on all pairs and the one on an active set share.
#pragma once

#include "base/aligned_array.h"
#include "base/kernel_dispatch.h"
#include "flbc/lbc_problem.h"
#include "linear/linear_solver.h"
#include "solver/methods/splitting/compact_data.h"
#include "solver/methods/splitting/row_state.h"
#include "solver/plan/constants.h"
#include "solver/run/iteration.h"

namespace flbc::splitting {

//! Squared norms in the metric, over cells.
struct CellResiduals {
  double motion = 0;     //!< of a change of the gradients
  double violation = 0;  //!< of z - grad w for the next z
};

//! Parameters of a splitting.
struct Parameters {
  double penalty = 1;                                  //!< rho > 0
  double relaxation = 1;                               //!< alpha in (0, 2)
  LinearSolver linear_solver = LinearSolver::kDirect;  //!< or kMultigrid; for all pairs
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

  int interval() const override { return parameters_.paper_residuals ? plan::kCheckInterval : 1; }

  //! Steps of compact_splitting.h. The w_step of the next iteration is fused with the y_step.
  //! \return change and, if the parameters ask for them, r_p of the next z_step and w_step, and r_d
  Step iterate(int made, int count) override;

  double penalty() const { return penalty_; }

  //! Writes the n weights of an interior vertex.
  void read_weights(Index vertex, double* weights) const;

  //! The penalty refers to all pairs. Flux densities are zero in cells between boundary vertices.
  Start<Dim> state() const override;

  //! The current p / A of a cell, n x Dim, admissible (start.h).
  Vectors<Dim> flux_density(Index cell) const;

 protected:
  using State = compact::Arrays<Scalar, Dim>;
  using SliceLoop = typename compact::Kernel<Scalar, Dim>::SliceLoop;
  using RowLoop = typename compact::Kernel<Scalar, Dim>::RowLoop;

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
  virtual void solve(SliceLoop loop, double relaxation) = 0;
  //! \return the squared change of w, in the units of the arrays
  virtual double pass_rows(RowLoop loop) = 0;
  //! Squared norms over cells with interior corners, for paper_residuals.
  //! \param moved  rows: a change of w
  virtual CellResiduals cell_residuals(const AlignedArray<Scalar>&) { return {}; }

  virtual Row row(Index index) const = 0;
  //! P of a cell with interior corners.
  virtual Vectors<Dim> cell_dual(Index cell) const = 0;
  virtual void set_cell_dual(const VectorsAt<Dim>& flux_density) = 0;
  //! Sets a, as sigma w. \param weights  of an interior vertex
  virtual void set_weights(const VectorsAt<1>& weights);

  const LbcProblem<Dim>& problem_;
  const compact::Kernel<Scalar, Dim>& kernel_;
  const Parameters parameters_;
  const Index n_;
  const Metric metric_;
  const double unit_;     // u
  const double penalty_;  // rho
  // made by the subclass; interior vertices in the order of its linear solver, then the boundary
  compact::CompactData<Scalar, Dim> data_;
  RowState<Scalar> rows_;
  AlignedArray<Scalar> P_;  // by cells with interior corners

 private:
  template <class Body>
  void for_row(Index vertex, const Body& body) const;
  Eigen::VectorXd vertex_dual_at(Index vertex) const;
  void set_vertex_dual(const VectorsAt<1>& vertex_dual);
  void measure_paper_residuals(const AlignedArray<Scalar>& moved, Step& step);
};

}  // namespace flbc::splitting
