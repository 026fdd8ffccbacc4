// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The weights of points: results of solves, and the input of all that uses weights.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "flbc/types.h"

namespace flbc {

//! The nonzero weights of each point. A dense matrix converts implicitly, so functions of the
//! library also accept n x P matrices. Convert once if you call many functions with the same
//! matrix.
class SparseWeights {
 public:
  //! No points.
  SparseWeights() = default;

  //! Keeps weights with |w| > threshold, without scaling them. With threshold 0 this is lossless.
  //! With a larger threshold the sum is no longer exactly 1.
  //! \param weights  n x P
  //! \param threshold  >= 0
  //! \throws OptionError if the threshold is negative or NaN
  SparseWeights(const WeightMatrix& weights, double threshold = 0);

  //! The same for other expressions of Eigen.
  template <class Derived>
  SparseWeights(const Eigen::MatrixBase<Derived>& weights, double threshold = 0)
      : SparseWeights(WeightMatrix(weights), threshold) {}

  //! Takes given arrays.
  //! \param num_control_points  n
  //! \param starts  P + 1 ascending numbers, the first is 0
  //! \param control_points  starts[P] indices in [0, n), ascending for each point
  //! \param values  starts[P] finite weights
  //! \throws InputError naming the first invalid point
  SparseWeights(Index num_control_points, std::vector<std::int64_t> starts,
                std::vector<std::uint32_t> control_points, std::vector<double> values);

  //! Calls a function for the weights of each point.
  //! \param num_control_points  n \param num_points  P
  //! \param of_point  returns n weights; called by several threads
  //! \throws InputError naming a point with another number of weights; what of_point throws
  static SparseWeights of(Index num_control_points, Index num_points,
                          const std::function<Eigen::VectorXd(Index)>& of_point);

  //! P.
  Index num_points() const { return static_cast<Index>(starts_.size()) - 1; }

  //! n.
  Index num_control_points() const { return num_control_points_; }

  //! P + 1 offsets: the weights of point p are entries starts[p] to starts[p + 1] - 1.
  const std::vector<std::int64_t>& starts() const { return starts_; }

  //! The control point of each weight, ascending for each point.
  const std::vector<std::uint32_t>& control_points() const { return control_points_; }

  //! The nonzero weights.
  const std::vector<double>& values() const { return values_; }

  //! Calls action(i, weight) for the weights of a point, by ascending control point i.
  //! \param point  in [0, P)
  template <class Action>
  void visit(Index point, const Action& action) const {
    for (std::int64_t k = starts_[point]; k < starts_[point + 1]; ++k) {
      action(static_cast<Index>(control_points_[k]), values_[k]);
    }
  }

  //! The number of stored weights of a point. \param point  in [0, P)
  Index count(Index point) const { return static_cast<Index>(starts_[point + 1] - starts_[point]); }

  //! Whether a point has weights other than zero. Points without weights do not move.
  //! \param point  in [0, P)
  bool has_weights(Index point) const;

  //! All n weights of a point, zeros included. \param point  in [0, P)
  Eigen::VectorXd at(Index point) const;

  //! The weights of all points for a control point, P numbers. \param control_point  in [0, n)
  Eigen::VectorXd of_control_point(Index control_point) const;

  //! The dense matrix, n x P.
  WeightMatrix dense() const;

  //! Whether all numbers are equal.
  friend bool operator==(const SparseWeights& a, const SparseWeights& b) {
    return a.num_control_points_ == b.num_control_points_ && a.starts_ == b.starts_ &&
           a.control_points_ == b.control_points_ && a.values_ == b.values_;
  }
  friend bool operator!=(const SparseWeights& a, const SparseWeights& b) { return !(a == b); }

 private:
  Index num_control_points_ = 0;
  std::vector<std::int64_t> starts_{0};
  std::vector<std::uint32_t> control_points_;
  std::vector<double> values_;
};

}  // namespace flbc
