// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The gradient ADMM of the paper (section 4.2.1 in 2D, 4.2.3 in 3D) in compact form.
#pragma once

#include <vector>

#include "base/aligned_array.h"
#include "flbc/lbc_problem.h"
#include "flbc/recovery.h"
#include "solver/methods/gradient/boundary_periods.h"
#include "solver/methods/gradient/cell_pass.h"
#include "solver/methods/gradient/constraint_data.h"
#include "solver/methods/gradient/gradient_kernel.h"

namespace flbc::gradient {

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
//! the extrapolated gradients 2 G - G_before therefore need only one value per tangent direction of
//! a facet (kernel: xy_step) and one vector per cell (z_step); g_step follows. See
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
               const std::vector<Period<Dim>>& periods);

  //! Starts from the least-norm solution of (8), duals zero.
  void start_from_least_norm();

  //! Starts from the gradients of given weights (n x V), duals zero.
  void start_from_weights(const WeightMatrix& weights);

  //! Performs iterations: X-, Y-, and Z-step with their duals, then the G-step. One call with a
  //! large count is faster than many calls, and bit-identical. \param count  at least 1 \return
  //! data of the last iteration for residuals()
  Change iterate(int count = 1);

  //! The residual norms of the paper after an iteration. With over-relaxation the primal residual
  //! is the violation X - G S_X, Y - G S_Y, Z - G at the extrapolated gradient.
  Residuals residuals(const Change& change) const;

  //! Number of components of r_p, equal to that of r_d.
  double num_residual_components() const;

  CellFieldView<Scalar, Dim> gradients() const { return {gradient_.data(), stride_, n_}; }

  //! The dual of the total variation, -mu u of Z = G: at an optimum phi A times the direction of
  //! the gradient. With over-relaxation it may temporarily be longer than phi A. Valid until the
  //! next call; not thread-safe.
  CellFieldView<Scalar, Dim> flux() const;

  //! Size of the state per cell and control point, without phi.
  double state_scalars_per_cell() const;

 private:
  void xyz_steps(const Arrays<Scalar, Dim>& arrays);
  void pass(const Arrays<Scalar, Dim>& arrays, bool note);
  Change g_step(const Arrays<Scalar, Dim>& arrays);
  double update_periods();
  double noted_change() const;
  Arrays<Scalar, Dim> make_arrays();

  const LbcProblem<Dim>& problem_;
  const Kernel<Scalar, Dim>& kernel_;
  const Index n_;
  const std::size_t stride_;
  const double penalty_;
  const double relaxation_;
  const std::size_t num_periods_;
  const double M_;  // of (11): number of copies of a gradient: in Z, in X or Y per facet, and per
                    // period
  // state
  AlignedArray<Scalar> gradient_;
  AlignedArray<Scalar> extrapolated_;
  AlignedArray<Scalar> tv_dual_;
  AlignedArray<Scalar> facet_dual_;
  AlignedArray<Scalar> period_dual_;
  mutable AlignedArray<Scalar> flux_;  // of the last call of flux()
  // data
  ConstraintData<Scalar, Dim> data_;
  std::vector<Scalar> period_fields_;
  AlignedArray<double> period_values_;
  // for passes
  CellPass cell_pass_;
  std::vector<AlignedArray<Scalar>> slots_;  // per part
  std::vector<double> cell_change_;
  std::vector<double> facet_change_;
};

}  // namespace flbc::gradient
