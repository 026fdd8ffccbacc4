// SPDX-License-Identifier: BSD-3-Clause
// Active-set quadratic program for the weights of one point: the nearest weights on few control
// points.
#pragma once

#include <vector>

#include "flbc/types.h"
#include "polytope/equality_qp.h"

namespace flbc {

//! The nonzero weights of one point, and their cost.
struct PointWeights {
  std::vector<Index> support{};  //!< ascending
  std::vector<double> values{};  //!< > 0, in the order of the support
  double cost = 0;               //!< (w - t) . H (w - t) - t . H t
};

//! Minimizes (w - t) . H (w - t) over w >= 0 with sum w = 1 and sum w c = x, for one point x and
//! target t at a time, on supports of few control points, by a primal active set method (Nocedal
//! and Wright, "Numerical Optimization", 16.5). Accurate to about 1e-8; callers must polish the
//! result. Not thread-safe, because it keeps its buffers.
template <int Dim>
class ActiveSetQp {
 public:
  //! \param metric  H, n x n
  //! \param control_points  Dim x n, kept by reference
  ActiveSetQp(Metric metric, const PointList<Dim>& control_points)
      : free_(metric, control_points), control_points_(control_points) {}

  const Metric& metric() const { return free_.metric(); }

  //! Sets the current point.
  //! \return H t, n, to be filled by the caller for the control points of the supports
  Eigen::VectorXd& aim_at(const Vector<Dim>& point);

  //! (w - t) . H (w - t) - t . H t, independent of weights.cost.
  double cost_of(const PointWeights& weights) const;

  //! The nearest weights on the support.
  //! \return false if x is not in the hull of the support, or if no weights cost less than `bound`
  bool solve(const std::vector<Index>& support, double bound, PointWeights& weights);

  //! Moves from feasible weights of known cost to the nearest ones on their support, plus control
  //! point `newcomer` if it is >= 0. The cost never increases.
  void descend(PointWeights& weights, Index newcomer = -1);

  //! Half the derivative of the cost with respect to the weight of a control point outside the
  //! support, minus the multipliers of sum and reproduction. Negative if the cost decreases as the
  //! weight grows. Needs settle().
  double slope(const PointWeights& weights, Index newcomer) const;

  //! Decrease of the cost if a control point with this slope enters and weights may become
  //! negative. Needs settle().
  double gain(double slope, Index newcomer) { return slope * slope / free_.curvature(newcomer); }

  //! Computes the multipliers of weights from solve() or descend().
  //! \return false if rounding hides them
  bool settle(const PointWeights& weights) { return free_.minimize(weights.support); }

  //! Lower bound on the increase of the cost if an influence is removed; exact if all others stay
  //! positive.
  //! \param weights  from solve() or descend()
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
  double slope(const std::vector<Index>& members, const std::vector<double>& weights,
               Index outside) const;
  bool is_feasible() const;
  void finish(PointWeights& weights) const;

  EqualityQp<Dim> free_;
  const PointList<Dim>& control_points_;
  Vector<Dim> point_;

  // State of the active-set method: free weights, and control points fixed at 0.
  std::vector<Index> members_;  // ascending
  std::vector<double> weights_;
  std::vector<Index> left_;
  bool at_minimum_ = false;  // whether the weights are the free minimum

  PointWeights lower_;
  std::vector<double> removal_costs_;
};

}  // namespace flbc
