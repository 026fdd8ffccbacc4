// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Which few control points carry a point best.
#pragma once

#include <vector>

#include "flbc/types.h"
#include "projection/dual_newton.h"

namespace flbc {

//! Looks for K control points S that make the least of
//!
//!     |w - y|^2   over   w >= 0,  sum w = 1,  sum w c = x,  w = 0 outside S.
//!
//! Works to about 1e-9: the weights on the chosen control points are to be computed anew.
template <int Dim>
class SupportSearch {
 public:
  //! Some control points and the nearest weights on them, all of them > 0.
  struct Choice {
    std::vector<Index> support;
    Eigen::VectorXd weights;  // in the order of the support
    double cost = 0;          // |w - y|^2 - |y|^2
  };

  //! \param control_points  Dim x n \param size  a length to measure them by
  //! \param point  x \param row  y, n, kept by reference
  SupportSearch(const PointList<Dim>& control_points, double size, const Vector<Dim>& point,
                const Eigen::VectorXd& row);

  //! The nearest weights on the given control points. \return false if x is not in their hull
  bool solve(const std::vector<Index>& support, Choice& choice) const;

  //! Removes influences, each time the one whose removal costs least, until `count` are left.
  //! \return false if rounding hides which of them are needed
  bool reduce(Index count, Choice& choice) const;

  //! Exchanges single influences as long as the cost falls.
  void exchange(Index count, Choice& choice) const;

 private:
  using Basis = typename DualNewton<Dim>::Basis;
  using Sums = typename DualNewton<Dim>::Sums;
  using Square = Eigen::Matrix<double, Dim + 1, Dim + 1>;

  struct Removal {
    double cost;
    Index position;
  };

  Square inverse_gram(const Choice& choice) const;
  bool remove_cheapest(Choice& choice) const;
  bool remove_plainly(const Choice& choice, const Square& inverse, const Removal& removal,
                      Choice& result) const;
  std::vector<Index> most_promising(const Choice& choice) const;

  Basis rows_;  // [1, (c - x) / size]
  const Eigen::VectorXd& row_;
};

}  // namespace flbc
