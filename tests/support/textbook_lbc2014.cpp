// SPDX-License-Identifier: BSD-3-Clause
#include "support/textbook_lbc2014.h"

#include "support/simplex.h"

namespace flbc::testing {

template <int Dim>
TextbookLbc2014<Dim>::TextbookLbc2014(Lbc2014Input<Dim> input) : input_(std::move(input)) {
  const auto& mesh = input_.mesh;
  const Eigen::Index n = input_.control_points.cols();
  const Eigen::Index m = input_.interior.size();
  const Eigen::Index rows = Dim * mesh.cells.cols();
  std::vector<Eigen::Index> place(mesh.points.cols(), -1);
  for (Eigen::Index k = 0; k < m; ++k) place[input_.interior[k]] = k;

  G_ = Eigen::MatrixXd::Zero(rows, m);
  E_ = Eigen::MatrixXd::Zero(rows, n);
  z_metric_.resize(rows);
  for (Index s = 0; s < mesh.cells.cols(); ++s) {
    const PointList<Dim> hats =
        linear_gradients<Dim>(cell_corners(mesh, s), Eigen::MatrixXd::Identity(Dim + 1, Dim + 1));
    for (int k = 0; k <= Dim; ++k) {
      const Index v = mesh.cells(k, s);
      if (place[v] >= 0) {
        G_.block(Dim * s, place[v], Dim, 1) = hats.col(k);
      } else {
        E_.middleRows(Dim * s, Dim) += hats.col(k) * input_.initial_weights.col(v).transpose();
      }
    }
    z_metric_.segment(Dim * s, Dim).setConstant(input_.cell_metric[s]);
  }
  w_metric_ = Eigen::VectorXd::Zero(m);
  if (input_.vertex_metric.size() > 0) {
    for (Eigen::Index k = 0; k < m; ++k) w_metric_[k] = input_.vertex_metric[input_.interior[k]];
  }

  // [1; c] w = [1; x]: the null space of the matrix on the left, and any solution.
  Eigen::MatrixXd constraints(Dim + 1, n);
  constraints.row(0).setOnes();
  constraints.bottomRows(Dim) = input_.control_points;
  M_ = null_space(constraints).transpose();
  Eigen::MatrixXd sums(Dim + 1, m);
  Eigen::MatrixXd start(m, n);
  for (Eigen::Index k = 0; k < m; ++k) {
    sums.col(k) << 1, mesh.points.col(input_.interior[k]);
    start.row(k) = input_.initial_weights.col(input_.interior[k]).transpose();
  }
  H_ = least_squares(constraints, sums).transpose();

  system_.compute(G_.transpose() * z_metric_.asDiagonal() * G_ +
                  Eigen::MatrixXd(w_metric_.asDiagonal()));
  Y_ = (start - H_) * M_.transpose();
  dual_z_ = input_.initial_z_dual.size() > 0 ? Eigen::MatrixXd(input_.initial_z_dual.transpose())
                                             : Eigen::MatrixXd::Zero(rows, n);
  dual_w_ = Eigen::MatrixXd::Zero(m, n);
}

template <int Dim>
Eigen::MatrixXd TextbookLbc2014<Dim>::gradients(const Eigen::MatrixXd& interior_weights) const {
  return G_ * interior_weights + E_;
}

template <int Dim>
void TextbookLbc2014<Dim>::iterate() {
  const Eigen::MatrixXd w = Y_ * M_ + H_;
  const Eigen::MatrixXd grad = gradients(w);
  // 1. W: nearest matrix within its bounds; Z: shrinkage of each gradient.
  const bool has_w = input_.vertex_metric.size() > 0;
  W_ = has_w ? Eigen::MatrixXd((w - dual_w_).cwiseMax(0)) : w;
  Z_ = grad - dual_z_;
  for (Index s = 0; s < input_.mesh.cells.cols(); ++s) {
    const double measure = simplex_measure<Dim>(cell_corners(input_.mesh, s));
    for (Eigen::Index i = 0; i < Z_.cols(); ++i) {
      auto z = Z_.block(Dim * s, i, Dim, 1);
      const double threshold =
          input_.phi(i, s) * measure / (input_.penalty * input_.cell_metric[s]);
      const double division =
          1 + input_.smoothness * measure / (input_.penalty * input_.cell_metric[s]);
      z *= z.norm() > threshold ? (1 - threshold / z.norm()) / division : 0.0;
    }
  }
  violation_z_ = Z_ - grad;
  violation_w_ = W_ - w;
  primal_residual_ = std::sqrt((z_metric_.asDiagonal() * violation_z_.cwiseAbs2()).sum() +
                               (w_metric_.asDiagonal() * violation_w_.cwiseAbs2()).sum());
  // 2. Y.
  const double alpha = input_.relaxation;
  const Eigen::MatrixXd relaxed_z = alpha * Z_ + (1 - alpha) * grad;
  const Eigen::MatrixXd relaxed_w = alpha * W_ + (1 - alpha) * w;
  const Eigen::MatrixXd right =
      G_.transpose() * z_metric_.asDiagonal() * (relaxed_z + dual_z_ - G_ * H_ - E_) +
      w_metric_.asDiagonal() * (relaxed_w + dual_w_ - H_);
  if (M_.rows() > 0) Y_ = system_.solve(right * M_.transpose());  // a simplex leaves no choice
  // 3. Duals.
  const Eigen::MatrixXd w_new = Y_ * M_ + H_;
  const Eigen::MatrixXd grad_new = gradients(w_new);
  dual_z_ += relaxed_z - grad_new;
  dual_w_ += relaxed_w - w_new;
  dual_residual_ =
      input_.penalty * std::sqrt((z_metric_.asDiagonal() * (grad_new - grad).cwiseAbs2()).sum() +
                                 (w_metric_.asDiagonal() * (w_new - w).cwiseAbs2()).sum());
}

template <int Dim>
Eigen::MatrixXd TextbookLbc2014<Dim>::weights() const {
  Eigen::MatrixXd all = input_.initial_weights;
  const Eigen::MatrixXd w = Y_ * M_ + H_;
  for (std::size_t k = 0; k < input_.interior.size(); ++k) {
    all.col(input_.interior[k]) = w.row(static_cast<Eigen::Index>(k)).transpose();
  }
  return all;
}

template class TextbookLbc2014<2>;
template class TextbookLbc2014<3>;

}  // namespace flbc::testing
