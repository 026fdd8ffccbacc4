// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights without their zeros.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "flbc/types.h"

namespace flbc {

//! Weights without their zeros, point by point: the form for many poses of local coordinates, and
//! the one that skinning takes.
class SparseWeights {
 public:
  //! No points.
  SparseWeights() = default;

  //! Keeps weights with |w| > threshold as they are; nothing is scaled, so that with threshold 0
  //! nothing is lost, and with a larger one the sum of the weights falls short of 1 by what was
  //! dropped.
  //! \param weights  n x P
  //! \param threshold  >= 0
  //! \throws OptionError if the threshold is negative or no number
  SparseWeights(const WeightMatrix& weights, double threshold = 0);

  //! Takes weights as they are.
  //! \param num_control_points  n
  //! \param starts  P + 1 numbers, the first one 0, ascending
  //! \param control_points  starts[P] of them in [0, n), ascending for each point
  //! \param values  as many, finite
  //! \throws InputError naming the point where something does not fit
  SparseWeights(Index num_control_points, std::vector<std::int64_t> starts,
                std::vector<std::uint32_t> control_points, std::vector<double> values);

  //! Asks for the weights of one point after the other.
  //! \param num_control_points  n \param num_points  P
  //! \param of_point  n numbers, of which zeros are left out; is asked by several threads
  static SparseWeights of(Index num_control_points, Index num_points,
                          const std::function<Eigen::VectorXd(Index)>& of_point);

  //! P.
  Index num_points() const { return static_cast<Index>(starts_.size()) - 1; }

  //! n.
  Index num_control_points() const { return num_control_points_; }

  //! P + 1 values: the weights of point p are numbers starts[p] up to starts[p + 1].
  const std::vector<std::int64_t>& starts() const { return starts_; }

  //! The control points they belong to, ascending for each point.
  const std::vector<std::uint32_t>& control_points() const { return control_points_; }

  //! Their values.
  const std::vector<double>& values() const { return values_; }

  //! Calls action(i, weight) for the weights of a point, by ascending control point i.
  //! \param point  in [0, P)
  template <class Action>
  void visit(Index point, const Action& action) const {
    for (std::int64_t k = starts_[point]; k < starts_[point + 1]; ++k) {
      action(static_cast<Index>(control_points_[k]), values_[k]);
    }
  }

  //! All weights of a point, n numbers. \param point  in [0, P)
  Eigen::VectorXd at(Index point) const;

  //! With their zeros, n x P.
  WeightMatrix dense() const;

 private:
  Index num_control_points_ = 0;
  std::vector<std::int64_t> starts_{0};
  std::vector<std::uint32_t> control_points_;
  std::vector<double> values_;
};

}  // namespace flbc
