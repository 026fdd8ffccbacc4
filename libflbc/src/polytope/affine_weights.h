// SPDX-License-Identifier: BSD-3-Clause
// The weights of a region that every pose moves by one affine map.
#pragma once

#include <vector>

#include "flbc/sparse_weights.h"
#include "flbc/types.h"

namespace flbc {

//! Weights w(x) = Y^T b(x) of the r points x of a region, with b(x) = (1, coordinates of x along
//! the principal axes of the region, in units of their root mean square). The feasible Y are
//!
//!     {Y : b(x) . y_i >= 0 for all x of the region, sum_i y_i (1, c_i)^T = S},
//!
//! where S makes the weights reproduce x. This is the polytope of a point (WeightProjection), but
//! with columns y_i in a cone in place of weights w_i >= 0, and the projection onto it is the same:
//! y_i = P(z_i + mu (1, c_i)), with P the projection onto the cone. A semismooth Newton method
//! finds mu. Few points of the region are corners of the cone: those that a result violates are
//! added.
template <int Dim>
class AffineWeights {
 public:
  static constexpr int kSize = Dim + 1;
  using Columns = Eigen::Matrix<double, kSize, Eigen::Dynamic>;

  //! \param control_points  Dim x n \param region  Dim x r, r >= 1
  AffineWeights(const PointList<Dim>& control_points, const PointList<Dim>& region);

  //! The Y that minimizes the sum of |w(x) - given weights|^2, whose weights may be negative.
  //! \param weights  of the r points
  Columns fit(const SparseWeights& weights) const;

  //! The feasible Y nearest to Z, and so to the weights that Z fits.
  //! \param support  control points, ascending; columns of all others are 0
  //! \return false if there is none
  bool project(const std::vector<Index>& support, const Columns& given, Columns& nearest) const;

  //! The same with at most so many control points, chosen greedily: the best simplex around the
  //! region, then one more at a time, then exchanges.
  //! \param support  as for project() \param given  a feasible Y
  bool reduce(const std::vector<Index>& support, Index most, const Columns& given,
              Columns& nearest) const;

  //! w(x), n. Numbers that are 0 up to rounding are 0.
  Eigen::VectorXd at(const Vector<Dim>& point, const Columns& y) const;

 private:
  using Column = Eigen::Matrix<double, kSize, 1>;
  using Square = Eigen::Matrix<double, kSize, kSize>;

  Column basis_at(const Vector<Dim>& point) const;
  bool minimize(Columns given, const Columns& places, const Columns& corners,
                Columns& nearest) const;
  std::vector<Index> best_simplex(const std::vector<Index>& pool, const Columns& given) const;

  Vector<Dim> center_, lengths_;
  Eigen::Matrix<double, Dim, Dim> axes_;
  Columns basis_;   // b(x) of the region
  Columns places_;  // (1, c_i) along the axes, in units of the size of the cage
  Square sums_;     // S
};

}  // namespace flbc
