// SPDX-License-Identifier: BSD-3-Clause
// Projection of one row of weights onto {w >= 0, sum w = 1, sum w c = x}.
#pragma once

#include <vector>

#include "flbc/types.h"
#include "polytope/dual_newton.h"

namespace flbc {

//! Projects rows of weights for one set of control points. Thread-safe; each thread needs its own
//! workspace.
template <int Dim>
class WeightProjection {
 public:
  using Sums = typename DualNewton<Dim>::Sums;

  //! \param control_points  Dim x n, n >= 1, finite
  explicit WeightProjection(const PointList<Dim>& control_points);

  class Workspace {
   public:
    explicit Workspace(const WeightProjection& projection) : newton_(projection.basis_) {}

   private:
    friend class WeightProjection;
    DualNewton<Dim> newton_;
    Eigen::VectorXd row_, scaled_, candidate_;
  };

  //! Whether the weights are non-negative, and sum and reproduction exact up to rounding.
  bool is_feasible(const Vector<Dim>& point, const Eigen::VectorXd& weights) const;

  //! Replaces the weights (finite) by the nearest feasible ones. A point outside the convex hull of
  //! the control points by at most 1e-9 of their size counts as the nearest point of the hull.
  //! \return 0, or the distance of a point farther outside, whose weights are unchanged
  double project(const Vector<Dim>& point, Eigen::VectorXd& weights, Workspace& work) const;

  //! The feasible weights on a support that are nearest to the given ones.
  //! \param support  each control point once
  //! \param given  n
  //! \param weights  replaced, n
  //! \return false if no such weights exist, or if rounding hides them
  bool project(const Vector<Dim>& point, const std::vector<Index>& support,
               const Eigen::VectorXd& given, Eigen::VectorXd& weights) const;

 private:
  friend class Workspace;

  Sums sums_of(const Vector<Dim>& point) const;
  double violation(const Sums& residual) const;
  bool newton_round(const Sums& sums, double delta, Workspace& work) const;
  bool many_rounds(const Sums& sums, Workspace& work) const;
  bool polish(const Sums& sums, Eigen::VectorXd& weights) const;
  void correct(const Sums& residual, bool careful, Eigen::VectorXd& weights) const;

  PointList<Dim> points_;
  double scale_;
  Vector<Dim> center_;
  Eigen::Matrix<double, Dim, Dim> axes_;   // principal axes of the control points, as columns
  Vector<Dim> lengths_;                    // their extent along each
  typename DualNewton<Dim>::Basis basis_;  // Q: [1; c] in these coordinates, orthonormal columns
};

}  // namespace flbc
