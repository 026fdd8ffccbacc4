// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The gradient ADMM of the paper (section 4.2.1 in 2D, 4.2.3 in 3D) in compact form.
#pragma once

#include <vector>

#include "flbc/lbc_problem.h"
#include "solver/methods/gradient/boundary_periods.h"
#include "solver/methods/gradient/constraint_data.h"

namespace flbc::gradient {

//! Squared changes of an iteration, for the residuals.
struct Change {
  double dual = 0;      //!< of all duals (both sides of a facet count)
  double gradient = 0;  //!< of G
  double lead = 0;      //!< difference of the new G from the extrapolated old one

  Change& operator+=(const Change& other) {
    dual += other.dual;
    gradient += other.gradient;
    lead += other.lead;
    return *this;
  }
};

//! Norms of the residual matrices r_p and r_d of the paper.
struct Residuals {
  double primal;
  double dual;
};

//! The iteration, allocated once. The paper minimizes (7) over gradients G subject to (8), (9), and
//! (10), with copies X = G S_X, Y = G S_Y, Z = G and a scaled dual u = lambda / mu for each:
//!
//!     X-step:  x_b = p - b (b . p - h_b),  p = g - u      boundary facets, tangential values (9)
//!     Y-step:  y_e = q_e +- d,  q = g - u                 interior facets, equal tangentially (10)
//!     Z-step:  z_s = a, shortened by phi A / mu, a = g - u                     the objective (7)
//!     G-step:  r_s = mean of its M copies x + u, y + u, z + u;  g_s = r_s, projected on (8)   (11)
//!     duals:   u += x - g, u += y - g, u += z - g
//!
//! Without over-relaxation, the gradients equal G of the paper in every iteration. A projection
//! onto a constraint changes a vector only along the constrained direction. Dual steps relative to
//! the extrapolated gradients e = 2 g - (g before) therefore need only one value per tangent
//! direction of a facet (x_step, y_step) and one vector per cell (z_step); g_step follows. See
//! docs/explanation/method/gradient_admm.md for the derivation.
//!
//! On domains with holes it also has period constraints, which the paper lacks.
template <class Scalar, int Dim>
class GradientAdmm {
 public:
  //! \param penalty  mu > 0
  //! \param relaxation  in (0, 2), 1 for the iteration of the paper
  //! \param periods  period constraints between boundary components; empty as in the paper
  GradientAdmm(const LbcProblem<Dim>& problem, double penalty, double relaxation,
               std::vector<Period<Dim>> periods);

  //! Starts from the least-norm solution of (8), duals zero.
  void start_from_least_norm();

  //! Starts from the gradients of given weights (n x V), duals zero.
  void start_from_weights(const WeightMatrix& weights);

  //! Performs iterations: X-, Y-, and Z-step with their duals, then the G-step. \param count  at
  //! least 1 \return changes of the last iteration
  Change iterate(int count = 1);

  //! The residual norms of the paper after an iteration. With over-relaxation the primal residual
  //! is the violation X - G S_X, Y - G S_Y, Z - G at the extrapolated gradient.
  Residuals residuals(const Change& change) const;

  //! Number of components of r_p, equal to that of r_d.
  double num_residual_components() const;

  CellFieldView<Scalar, Dim> gradients() const { return view(gradient_); }

  //! The dual of the total variation, -mu u of Z = G: at an optimum phi A times the direction of
  //! the gradient. With over-relaxation it may temporarily be longer than phi A. Valid until the
  //! next call; not thread-safe.
  CellFieldView<Scalar, Dim> flux() const;

  //! Size of the state per cell and control point, without phi.
  double state_scalars_per_cell() const;

 private:
  using Vectors = Eigen::Matrix<Scalar, Eigen::Dynamic, Dim>;  // one per control point
  using Tangential = Eigen::Matrix<Scalar, Eigen::Dynamic, Dim - 1>;
  using Factors = Eigen::Array<Scalar, Eigen::Dynamic, 1>;

  // Work memory of a thread.
  struct Scratch {
    Vectors vectors, step;
    Tangential tangential;
    Factors factors;
  };

  Change x_step(Index facet, Scratch& scratch);
  Change y_step(Index facet, Scratch& scratch);
  Change z_step(Index cell, Scratch& scratch);
  Change period_step(std::size_t period);
  Change g_step(Index cell, Scratch& scratch);
  void average_candidates(Index cell, Vectors& average) const;
  void shrink(Index cell, Vectors& vectors, Factors& factors) const;
  template <class GradientsOf>
  void start(const GradientsOf& gradients_of);
  template <class Step>
  Change for_all(Index count, const Step& step);

  CellFieldView<Scalar, Dim> view(const Field<Scalar>& field) const {
    return {field.data(), static_cast<std::size_t>(field.rows()), n_};
  }

  const LbcProblem<Dim>& problem_;
  const Index n_;
  const double penalty_;
  const Scalar relaxation_;
  const std::vector<Period<Dim>> periods_;
  const double M_;  // of (11): number of copies of a gradient: in Z, in X or Y per facet, and per
                    // period
  const ConstraintData<Scalar, Dim> data_;
  // state
  Field<Scalar> gradient_;      // Dim columns per cell: G
  Field<Scalar> extrapolated_;  // Dim columns per cell: 2 G - G before
  Field<Scalar> tv_dual_;       // Dim columns per cell: dual of Z = G
  Field<Scalar> facet_dual_;    // Dim - 1 columns per facet: tangential dual of X = G S_X on the
                                // boundary, of Y = G S_Y inside, positive on its first side
  Field<Scalar> period_dual_;   // a column per period
  mutable Field<Scalar> flux_;  // of the last call of flux()
};

}  // namespace flbc::gradient
