// SPDX-License-Identifier: BSD-3-Clause
#include "support/textbook_admm.h"

#include <stdexcept>
#include <utility>

#include <Eigen/Geometry>

namespace flbc::testing {
namespace {

// G S: the rows of G that belong to the given cells, one block of Dim rows after the other.
template <int Dim>
Eigen::MatrixXd select(const Eigen::MatrixXd& G, const std::vector<Index>& cells) {
  Eigen::MatrixXd selected(Dim * static_cast<Eigen::Index>(cells.size()), G.cols());
  for (std::size_t k = 0; k < cells.size(); ++k) {
    selected.middleRows(Dim * k, Dim) = G.middleRows(Dim * cells[k], Dim);
  }
  return selected;
}

template <int Dim>
void check_sizes(const TextbookInput<Dim>& input) {
  const auto n = input.control_points.cols();
  const auto num_cells = input.mesh.cells.cols();
  bool fits = input.phi.rows() == n && input.phi.cols() == num_cells &&
              input.boundary_weights.rows() == n &&
              input.boundary_weights.cols() == input.mesh.points.cols() &&
              static_cast<Eigen::Index>(input.initial_gradients.size()) == num_cells;
  for (const auto& block : input.initial_gradients) fits = fits && block.cols() == n;
  if (!fits) throw std::invalid_argument("textbook solver: sizes of the input do not fit");
  if (!(input.penalty > 0)) throw std::invalid_argument("textbook solver: penalty not positive");
}

// Projector onto the tangent space of a facet: e e^T for an edge, I - n n^T for a triangle.
template <int Dim>
Eigen::Matrix<double, Dim, Dim> tangent_projector(const PointList<Dim>& corners) {
  const PointList<Dim> edges = edges_of<Dim>(corners);
  if constexpr (Dim == 2) {
    const Vector<2> e = edges.col(0).normalized();
    return e * e.transpose();
  } else {
    const Vector<3> first = edges.col(0);
    const Vector<3> normal = first.cross(Vector<3>(edges.col(1))).normalized();
    return Eigen::Matrix3d::Identity() - normal * normal.transpose();
  }
}

}  // namespace

template <int Dim>
TextbookAdmm<Dim>::TextbookAdmm(TextbookInput<Dim> input)
    : input_(std::move(input)), n_(input_.control_points.cols()) {
  check_sizes(input_);
  find_facets();
  solve_local_system();
  const Index num_cells = input_.mesh.num_cells();
  G_.resize(Dim * num_cells, n_);
  for (Index s = 0; s < num_cells; ++s) {
    G_.middleRows(Dim * s, Dim) = input_.initial_gradients[s];
    measures_.push_back(
        simplex_measure<Dim>(corners_of<Dim>(input_.mesh.points, input_.mesh.cells.col(s))));
  }
  previous_G_ = G_;
  Z_ = G_;
  X_ = select<Dim>(G_, x_cells_);
  Y_ = select<Dim>(G_, y_cells_);
  lambda_Z_ = Eigen::MatrixXd::Zero(Z_.rows(), n_);
  lambda_X_ = Eigen::MatrixXd::Zero(X_.rows(), n_);
  lambda_Y_ = Eigen::MatrixXd::Zero(Y_.rows(), n_);
}

template <int Dim>
void TextbookAdmm<Dim>::find_facets() {
  for (const auto& [vertices, cells] : cells_by_facet(input_.mesh)) {
    if (cells.size() > 2) throw std::invalid_argument("textbook solver: a facet has three cells");
    if (cells.size() == 1) {
      boundary_.push_back(vertices);
      x_cells_.push_back(cells[0]);
      h_.push_back(linear_gradients<Dim>(corners_of<Dim>(input_.mesh.points, vertices),
                                         columns_of(input_.boundary_weights, vertices)));
    } else {
      interior_.push_back(vertices);
      y_cells_.push_back(cells[0]);
      y_cells_.push_back(cells[1]);
    }
  }
}

// The system (8) of a cell: A g^T = B with rows 1^T and C of A. Its matrix is the same everywhere.
template <int Dim>
void TextbookAdmm<Dim>::solve_local_system() {
  Eigen::MatrixXd A(Dim + 1, n_);
  A.row(0).setOnes();
  A.bottomRows(Dim) = input_.control_points;
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(Dim + 1, Dim);
  B.bottomRows(Dim).setIdentity();
  const Eigen::MatrixXd basis = null_space(A);
  if (basis.cols() > n_ - (Dim + 1)) {
    throw std::invalid_argument("textbook solver: the control points lie in a hyperplane");
  }
  least_norm_ = least_squares(A, B).transpose();
  K_ = basis * basis.transpose();
}

template <int Dim>
void TextbookAdmm<Dim>::iterate() {
  update_x();
  update_y();
  update_z();
  update_g();
  update_duals();
}

// x = p - P (p - h): in 2D, P = b b^T makes it p - b (b . p - h_b).
template <int Dim>
void TextbookAdmm<Dim>::update_x() {
  const Eigen::MatrixXd p = select<Dim>(G_, x_cells_) - lambda_X_ / input_.penalty;
  for (std::size_t b = 0; b < boundary_.size(); ++b) {
    const auto P = tangent_projector<Dim>(corners_of<Dim>(input_.mesh.points, boundary_[b]));
    const Block p_b = p.middleRows(Dim * b, Dim);
    X_.middleRows(Dim * b, Dim) = p_b - P * (p_b - h_[b]);
  }
}

// Tangential parts are averaged, normal parts are kept.
template <int Dim>
void TextbookAdmm<Dim>::update_y() {
  const Eigen::MatrixXd q = select<Dim>(G_, y_cells_) - lambda_Y_ / input_.penalty;
  for (std::size_t e = 0; e < interior_.size(); ++e) {
    const auto P = tangent_projector<Dim>(corners_of<Dim>(input_.mesh.points, interior_[e]));
    const Block q_1 = q.middleRows(2 * Dim * e, Dim);
    const Block q_2 = q.middleRows(2 * Dim * e + Dim, Dim);
    const Block d = 0.5 * P * (q_2 - q_1);
    Y_.middleRows(2 * Dim * e, Dim) = q_1 + d;
    Y_.middleRows(2 * Dim * e + Dim, Dim) = q_2 - d;
  }
}

// Shrinkage, with the norm that the paper's formula lacks, and the quadratic term's division.
template <int Dim>
void TextbookAdmm<Dim>::update_z() {
  const Eigen::MatrixXd a = G_ - lambda_Z_ / input_.penalty;
  for (Index s = 0; s < input_.mesh.num_cells(); ++s) {
    for (Eigen::Index i = 0; i < n_; ++i) {
      const Vector<Dim> a_si = a.block(Dim * s, i, Dim, 1);
      const double threshold = input_.phi(i, s) * measures_[s] / input_.penalty;
      const double norm = a_si.norm();
      if (norm <= threshold) {
        Z_.block(Dim * s, i, Dim, 1).setZero();
      } else {
        const double division = 1 + input_.smoothness * measures_[s] / input_.penalty;
        Z_.block(Dim * s, i, Dim, 1) = (1 - threshold / norm) / division * a_si;
      }
    }
  }
}

template <int Dim>
void TextbookAdmm<Dim>::update_g() {
  const double mu = input_.penalty;
  Eigen::MatrixXd r = Z_ + lambda_Z_ / mu;
  std::vector<double> M(measures_.size(), 1.0);
  for (std::size_t t = 0; t < x_cells_.size(); ++t) {
    r.middleRows(Dim * x_cells_[t], Dim) +=
        X_.middleRows(Dim * t, Dim) + lambda_X_.middleRows(Dim * t, Dim) / mu;
    M[x_cells_[t]] += 1;
  }
  for (std::size_t u = 0; u < y_cells_.size(); ++u) {
    r.middleRows(Dim * y_cells_[u], Dim) +=
        Y_.middleRows(Dim * u, Dim) + lambda_Y_.middleRows(Dim * u, Dim) / mu;
    M[y_cells_[u]] += 1;
  }
  previous_G_ = G_;
  for (std::size_t s = 0; s < M.size(); ++s) {
    const Block r_s = r.middleRows(Dim * s, Dim) / M[s];
    G_.middleRows(Dim * s, Dim) = least_norm_ + (r_s - least_norm_) * K_.transpose();
  }
}

template <int Dim>
void TextbookAdmm<Dim>::update_duals() {
  lambda_X_ += input_.penalty * (X_ - select<Dim>(G_, x_cells_));
  lambda_Y_ += input_.penalty * (Y_ - select<Dim>(G_, y_cells_));
  lambda_Z_ += input_.penalty * (Z_ - G_);
}

template <int Dim>
double TextbookAdmm<Dim>::primal_residual_norm() const {
  return std::sqrt((X_ - select<Dim>(G_, x_cells_)).squaredNorm() +
                   (Y_ - select<Dim>(G_, y_cells_)).squaredNorm() + (Z_ - G_).squaredNorm());
}

template <int Dim>
double TextbookAdmm<Dim>::dual_residual_norm() const {
  const Eigen::MatrixXd delta = G_ - previous_G_;
  return input_.penalty *
         std::sqrt(select<Dim>(delta, x_cells_).squaredNorm() +
                   select<Dim>(delta, y_cells_).squaredNorm() + delta.squaredNorm());
}

template <int Dim>
Eigen::Index TextbookAdmm<Dim>::num_residual_components() const {
  return X_.size() + Y_.size() + Z_.size();
}

template <int Dim>
auto TextbookAdmm<Dim>::gradient(Index cell) const -> Block {
  return G_.middleRows(Dim * cell, Dim);
}

template class TextbookAdmm<2>;
template class TextbookAdmm<3>;

}  // namespace flbc::testing
