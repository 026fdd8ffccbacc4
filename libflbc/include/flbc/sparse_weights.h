// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The weights of points: results of solves, and the input of all that uses weights.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "flbc/types.h"

namespace flbc {

//! The nonzero weights of each point. A dense matrix converts implicitly, so functions of the
//! library also accept n x P matrices. Convert once if you call many functions with the same
//! matrix. Copies share their entries, which never change.
class SparseWeights {
 public:
  //! No points.
  SparseWeights() : SparseWeights(0, {}) {}

  // Without moves: what was moved from would have no entries.
  SparseWeights(const SparseWeights&) = default;
  SparseWeights& operator=(const SparseWeights&) = default;

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
  Index num_points() const { return static_cast<Index>(starts().size()) - 1; }

  //! n.
  Index num_control_points() const { return num_control_points_; }

  //! P + 1 offsets: the weights of point p are entries starts[p] to starts[p + 1] - 1.
  const std::vector<std::int64_t>& starts() const { return entries_->starts; }

  //! The control point of each weight, ascending for each point.
  const std::vector<std::uint32_t>& control_points() const { return entries_->control_points; }

  //! The nonzero weights.
  const std::vector<double>& values() const { return entries_->values; }

  //! Calls action(i, weight) for the weights of a point, by ascending control point i.
  //! \param point  in [0, P)
  template <class Action>
  void visit(Index point, const Action& action) const {
    const auto& [starts, control_points, values] = *entries_;
    for (std::int64_t k = starts[point]; k < starts[point + 1]; ++k) {
      action(static_cast<Index>(control_points[k]), values[k]);
    }
  }

  //! The number of stored weights of a point. \param point  in [0, P)
  Index count(Index point) const {
    return static_cast<Index>(starts()[point + 1] - starts()[point]);
  }

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
    return a.num_control_points_ == b.num_control_points_ &&
           (a.entries_ == b.entries_ ||
            (a.starts() == b.starts() && a.control_points() == b.control_points() &&
             a.values() == b.values()));
  }
  friend bool operator!=(const SparseWeights& a, const SparseWeights& b) { return !(a == b); }

 private:
  struct Entries {
    std::vector<std::int64_t> starts{0};
    std::vector<std::uint32_t> control_points;
    std::vector<double> values;
  };

  SparseWeights(Index num_control_points, Entries entries)
      : num_control_points_(num_control_points),
        entries_(std::make_shared<const Entries>(std::move(entries))) {}

  Index num_control_points_ = 0;
  std::shared_ptr<const Entries> entries_;
};

}  // namespace flbc
