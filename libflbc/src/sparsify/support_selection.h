// SPDX-License-Identifier: BSD-3-Clause
// Selects the best few control points for a point, in any metric.
#pragma once

#include <vector>

#include "polytope/active_set_qp.h"

namespace flbc {

//! Minimum given weight of a control point that enters a support. Control points with almost no
//! weight are usually far away and move differently when the cage bends.
constexpr double kLeastInfluence = 1e-3;

//! Improves the support of one point by local moves. Not thread-safe, because it keeps its buffers.
template <int Dim>
class SupportSelection {
 public:
  //! \param metric  H, n x n
  //! \param control_points  Dim x n, kept by reference
  SupportSelection(Metric metric, const PointList<Dim>& control_points)
      : qp_(metric, control_points) {}

  //! The program that computes weights on a support; set its point first.
  ActiveSetQp<Dim>& qp() { return qp_; }

  //! Repeatedly removes the cheapest influence until `count` are left.
  //! \param weights  from the active-set QP; invalid if the result is false
  //! \return false if no weights with a cost below `bound` were found
  bool reduce(Index count, double bound, PointWeights& weights);

  //! Switches to another support, ascending, if the cost decreases by more than `least_gain`.
  void adopt(const std::vector<Index>& support, double least_gain, PointWeights& weights);

  //! Inserts single influences, in exchange for others if there are more than `count`, while the
  //! cost decreases by more than `least_gain`.
  //! \param may_enter  control points
  void exchange(Index count, double least_gain, const std::vector<Index>& may_enter,
                PointWeights& weights);

 private:
  struct Candidate {
    double cost;
    Index number;
    bool operator<(const Candidate& other) const {
      return cost != other.cost ? cost < other.cost : number < other.number;
    }
  };

  bool remove_cheapest(double bound, PointWeights& weights);
  bool exchange_one(Index count, double least_gain, PointWeights& weights);
  void find_newcomers(const std::vector<Index>& may_enter, const PointWeights& weights);

  ActiveSetQp<Dim> qp_;
  std::vector<Candidate> newcomers_, removals_;
  std::vector<Index> support_;
  PointWeights trial_, least_, exchanged_;
};

}  // namespace flbc
