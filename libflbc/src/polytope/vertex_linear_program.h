// SPDX-License-Identifier: BSD-3-Clause
// The linear program of one interior vertex in the Lagrangian dual bound.
#pragma once

#include <array>

#include "flbc/types.h"
#include "polytope/small_lu.h"

namespace flbc {

//! min { omega . costs : omega >= 0, sum omega = 1, sum omega c = x } for one set of control points
//! and many x, by the primal simplex method. A basis has only Dim + 1 control points, so it is
//! refactored in every step. Not thread-safe, because it keeps its buffers.
template <int Dim>
class VertexLinearProgram {
 public:
  //! \param control_points  Dim x n, n >= 1, kept by reference
  explicit VertexLinearProgram(const PointList<Dim>& control_points);

  //! A lower bound of the minimum by weak duality, which accounts for rounding. It equals the
  //! minimum up to rounding if x lies in the hull of the control points. Since sum omega = 1, every
  //! y in R^Dim gives the bound min_i costs_i - y . (c_i - x).
  //! \param start  n weights, ideally feasible and near the optimum; others only cost time
  double lower_bound(const Vector<Dim>& point, const Eigen::VectorXd& costs,
                     const Eigen::VectorXd& start);

  //! y of the last bound.
  Vector<Dim> multipliers() const { return best_multipliers_.template tail<Dim>() / scale_; }

 private:
  static constexpr int kRows = Dim + 1;
  using Sums = Eigen::Matrix<double, kRows, 1>;
  using Square = Eigen::Matrix<double, kRows, kRows>;

  bool start_from(const Eigen::VectorXd& start, const Eigen::VectorXd& costs);
  bool choose_basis(const Eigen::VectorXd& start);
  void push_to_zero(Index entering, double value, const Eigen::VectorXd& costs);
  void iterate(const Eigen::VectorXd& costs);
  Eigen::Index choose_entering(bool first, double tolerance) const;
  int choose_leaving(const Sums& column, bool first) const;
  void factor();
  Sums basic_costs(const Eigen::VectorXd& costs) const { return costs(basis_); }
  double rigorous_bound(const Eigen::VectorXd& costs);

  const PointList<Dim>& points_;
  double scale_;
  Eigen::Matrix<double, Eigen::Dynamic, kRows> columns_;  // of the program: [1, (c - x) / size]
  Eigen::Matrix<double, Eigen::Dynamic, kRows> rest_;     // of the columns, next to a basis
  Eigen::VectorXd reduced_costs_;
  std::array<Index, kRows> basis_{};
  Sums values_;  // of the basic variables
  SmallLu<kRows> lu_;
  Sums best_multipliers_;
};

}  // namespace flbc
