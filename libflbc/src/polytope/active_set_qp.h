// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The active-set quadratic program of one point's weights: the nearest ones on few control points.
#pragma once

#include <vector>

#include "flbc/types.h"
#include "polytope/equality_qp.h"

namespace flbc {

//! The weights of one point that are not 0, and their cost.
struct PointWeights {
  std::vector<Index> support{};  //!< ascending
  std::vector<double> values{};  //!< > 0, in the order of the support
  double cost = 0;               //!< (w - t) . H (w - t) - t . H t
};

//! Minimises (w - t) . H (w - t) over w >= 0 with sum w = 1 and sum w c = x, for one point x and
//! target t at a time, on supports of few control points, by a primal active set method (Nocedal
//! and Wright, "Numerical Optimization", 16.5). Works to about 1e-8: results are to be polished.
//! Keeps its buffers: one per thread.
template <int Dim>
class ActiveSetQp {
 public:
  //! \param metric  H, n x n
  //! \param control_points  Dim x n, kept by reference
  ActiveSetQp(Metric metric, const PointList<Dim>& control_points)
      : free_(metric, control_points), control_points_(control_points) {}

  const Metric& metric() const { return free_.metric(); }

  //! From here on for this point.
  //! \return H t, n, to be filled in
  Eigen::VectorXd& aim_at(const Vector<Dim>& point);

  //! (w - t) . H (w - t) - t . H t, whatever weights.cost says.
  double cost_of(const PointWeights& weights) const;

  //! The nearest weights on the support.
  //! \return false if x is not in the hull of the support, or if surely none cost less than `bound`
  bool solve(const std::vector<Index>& support, double bound, PointWeights& weights);

  //! Goes from feasible weights to the nearest ones on their support, to which a newcomer is added
  //! if it is >= 0. The cost never rises.
  void descend(PointWeights& weights, Index newcomer = -1);

  //! Half the derivative of the cost by each weight, less the forces of sum and reproduction:
  //! negative where a weight would like to grow.
  //! \param weights  as found by solve() or descend()
  //! \return n, zeros if rounding hides them
  const Eigen::VectorXd& slopes(const PointWeights& weights);

  //! By how much the cost falls when a control point enters, all weights being free to become
  //! negative. After slopes().
  double gain(Index newcomer) {
    return slopes_[newcomer] * slopes_[newcomer] / free_.curvature(newcomer);
  }

  //! By how much the cost rises at least when an influence goes; exactly, if all others then stay
  //! positive.
  //! \param weights  as found by solve() or descend()
  //! \return in the order of the support
  const std::vector<double>& removal_costs(const PointWeights& weights);

 private:
  using Sums = typename EqualityQp<Dim>::Sums;

  bool start_without_negative(const std::vector<Index>& support);
  bool start_in_hull(const std::vector<Index>& support);
  void descend_to_minimum();
  void enter(Index control_point, double weight);
  std::size_t step_to_free_minimum();
  std::size_t most_wanted() const;
  bool is_feasible() const;
  bool finish(PointWeights& weights);

  EqualityQp<Dim> free_;
  const PointList<Dim>& control_points_;
  Vector<Dim> point_;

  // Of the active set method: the free weights, and the control points held at 0 at present.
  std::vector<Index> members_;  // ascending
  std::vector<double> weights_;
  std::vector<Index> left_;

  PointWeights lower_;
  Eigen::VectorXd slopes_;
  std::vector<double> removal_costs_;
};

}  // namespace flbc
