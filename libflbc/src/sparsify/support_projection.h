// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Exactly feasible weights on given control points.
#pragma once

#include <vector>

#include "flbc/types.h"
#include "polytope/weight_projection.h"

namespace flbc {

//! Projects the weights of one point on {w >= 0, sum w = 1, sum w c = x, w = 0 outside of a
//! support}. Shared by threads.
template <int Dim>
class SupportProjection {
 public:
  //! \param control_points  Dim x n, kept by reference
  explicit SupportProjection(const PointList<Dim>& control_points)
      : control_points_(control_points), all_(control_points) {}

  //! Are the weights non-negative, and sum and reproduction exact up to rounding?
  //! \param weights  n
  bool is_feasible(const Vector<Dim>& point, const Eigen::VectorXd& weights) const {
    return all_.is_feasible(point, weights);
  }

  //! The exactly feasible weights on the support that are nearest to those given.
  //! \param support  each control point once
  //! \param given  n
  //! \param weights  replaced, n
  //! \return false if there are none, or if rounding hides them
  bool project(const Vector<Dim>& point, const std::vector<Index>& support,
               const Eigen::VectorXd& given, Eigen::VectorXd& weights) const;

 private:
  const PointList<Dim>& control_points_;
  WeightProjection<Dim> all_;
};

}  // namespace flbc
