// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The optimum with a quadratic term by Newton's method on dense matrices, for tiny problems. It
//! shares neither method nor code with the solvers.
#pragma once

#include "flbc/lbc_problem.h"
#include "support/test.h"

namespace flbc::testing {

//! Minimizes sum A (phi sqrt(|grad w|^2 + delta^2) + epsilon / 2 |grad w|^2) - delta sum log w
//! under the linear constraints, for delta falling to 1e-11.
template <int Dim>
class NewtonOptimum {
 public:
  //! \param start  feasible weights, n x V
  NewtonOptimum(const LbcProblem<Dim>& problem, const Eigen::MatrixXd& start, bool non_negative)
      : problem_(problem),
        start_(start),
        non_negative_(non_negative),
        interior_(problem.boundary.interior_vertices()) {
    const auto& mesh = problem.mesh;
    std::vector<Eigen::Index> place(mesh.num_vertices(), -1);
    for (std::size_t k = 0; k < interior_.size(); ++k) place[interior_[k]] = k;
    const Eigen::Index n = start.rows(), m = num_unknowns();
    inner_ = Eigen::MatrixXd::Zero(Dim * mesh.num_cells(), m);
    known_ = Eigen::MatrixXd::Zero(Dim * mesh.num_cells(), n);
    for (Index s = 0; s < mesh.num_cells(); ++s) {
      const auto corners = cell_corners(mesh, s);
      measures_.push_back(simplex_measure<Dim>(corners));
      const auto hats = linear_gradients<Dim>(corners, Eigen::MatrixXd::Identity(Dim + 1, Dim + 1));
      for (int k = 0; k <= Dim; ++k) {
        const Index v = mesh.cells(k, s);
        if (place[v] >= 0) {
          inner_.block(Dim * s, place[v], Dim, 1) = hats.col(k);
        } else {
          known_.middleRows(Dim * s, Dim) += hats.col(k) * start.col(v).transpose();
        }
      }
    }
    Eigen::MatrixXd constraints(Dim + 1, n);
    constraints << Eigen::RowVectorXd::Ones(n), problem.cage.points;
    null_space_ = null_space(constraints);
  }

  //! \return the optimum, n x V; nothing if the start is not positive although it has to be
  std::optional<Eigen::MatrixXd> find() {
    Eigen::MatrixXd w(start_.rows(), num_unknowns());
    for (Eigen::Index k = 0; k < w.cols(); ++k) w.col(k) = start_.col(interior_[k]);
    if (non_negative_ && w.minCoeff() <= 1e-9) return {};
    for (double delta = 0.1; delta > 0.5e-11; delta /= 4) {
      for (int step = 0; step < 60 && improve(w, delta); ++step) {
      }
    }
    Eigen::MatrixXd all = start_;
    for (Eigen::Index k = 0; k < w.cols(); ++k) all.col(interior_[k]) = w.col(k);
    return all;
  }

 private:
  Eigen::Index num_unknowns() const { return static_cast<Eigen::Index>(interior_.size()); }

  Eigen::MatrixXd gradients(const Eigen::MatrixXd& w) const {
    return inner_ * w.transpose() + known_;
  }

  double value(const Eigen::MatrixXd& w, double delta) const {
    if (non_negative_ && w.minCoeff() <= 0) return std::numeric_limits<double>::infinity();
    const Eigen::MatrixXd g = gradients(w);
    double sum = non_negative_ ? -delta * w.array().log().sum() : 0;
    for (std::size_t s = 0; s < measures_.size(); ++s) {
      for (Eigen::Index i = 0; i < w.rows(); ++i) {
        const double squared = g.block(Dim * s, i, Dim, 1).squaredNorm();
        sum += measures_[s] * (problem_.phi(i, s) * std::sqrt(squared + delta * delta) +
                               problem_.smoothness / 2 * squared);
      }
    }
    return sum;
  }

  // A damped Newton step. \return whether there may be more to gain
  bool improve(Eigen::MatrixXd& w, double delta) const {
    const Eigen::Index n = w.rows(), m = w.cols(), k = null_space_.cols();
    const Eigen::MatrixXd g = gradients(w);
    Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(m, n);
    Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(m * k, m * k);
    for (Eigen::Index i = 0; i < n; ++i) {
      Eigen::MatrixXd bend = Eigen::MatrixXd::Zero(m, m);
      for (std::size_t s = 0; s < measures_.size(); ++s) {
        const Eigen::MatrixXd rows = inner_.middleRows(Dim * s, Dim);
        const Vector<Dim> z = g.block(Dim * s, i, Dim, 1);
        const double length = std::sqrt(z.squaredNorm() + delta * delta);
        const double phi = problem_.phi(i, s);
        slope.col(i) += measures_[s] * (phi / length + problem_.smoothness) * rows.transpose() * z;
        const Eigen::Matrix<double, Dim, Dim> unit = Eigen::Matrix<double, Dim, Dim>::Identity();
        const Eigen::Matrix<double, Dim, Dim> inner =
            phi / length * (unit - z * z.transpose() / (length * length)) +
            problem_.smoothness * unit;
        bend += measures_[s] * rows.transpose() * inner * rows;
      }
      if (non_negative_) {
        slope.col(i) -= delta * w.row(i).cwiseInverse().transpose();
        bend.diagonal() += delta * w.row(i).cwiseAbs2().cwiseInverse().transpose();
      }
      for (Eigen::Index a = 0; a < k; ++a) {
        for (Eigen::Index b = 0; b < k; ++b) {
          hessian.block(a * m, b * m, m, m) += null_space_(i, a) * null_space_(i, b) * bend;
        }
      }
    }
    const Eigen::MatrixXd reduced = slope * null_space_;  // m x k
    const Eigen::VectorXd right = -reduced.reshaped();
    const Eigen::VectorXd step = solve_symmetric(hessian, right);
    const double decrease = step.dot(right);
    if (!(decrease > 1e-16)) return false;
    const Eigen::MatrixXd direction = null_space_ * step.reshaped(m, k).transpose();
    const double before = value(w, delta);
    for (double length = 1; length > 1e-10; length /= 2) {
      const Eigen::MatrixXd next = w + length * direction;
      if (value(next, delta) < before - 1e-4 * length * decrease) {
        w = next;
        return true;
      }
    }
    return false;
  }

  const LbcProblem<Dim>& problem_;
  const Eigen::MatrixXd start_;
  const bool non_negative_;
  const std::vector<Index> interior_;
  Eigen::MatrixXd inner_, known_;  // gradients of interior and of boundary weights
  Eigen::MatrixXd null_space_;     // n x (n - Dim - 1)
  std::vector<double> measures_;
};

}  // namespace flbc::testing
