// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Which few control points carry a point best, in any metric.
#pragma once

#include <vector>

#include "polytope/active_set_qp.h"

namespace flbc {

//! Newcomers to a support must have had this weight: a control point with next to no influence is
//! far away as a rule, and bends of the cage move it otherwise than those nearby.
constexpr double kLeastInfluence = 1e-3;

//! Improves the support of one point's weights by moves that are tried one after the other. Keeps
//! its buffers: one per thread.
template <int Dim>
class SupportSelection {
 public:
  //! \param metric  H, n x n
  //! \param control_points  Dim x n, kept by reference
  SupportSelection(Metric metric, const PointList<Dim>& control_points)
      : qp_(metric, control_points) {}

  //! Computes the weights on a support; it has to be aimed at the point first.
  ActiveSetQp<Dim>& qp() { return qp_; }

  //! Removes influences, each time the one whose removal costs least, until `count` are left.
  //! \param weights  as the active-set QP gave them; of no use any more if the result is false
  //! \return false if no weights were found that cost less than `bound`
  bool reduce(Index count, double bound, PointWeights& weights);

  //! Takes the weights on another support, ascending, if they cost less by more than `least_gain`.
  void adopt(const std::vector<Index>& support, double least_gain, PointWeights& weights);

  //! Lets single influences in, for others if there are more than `count`, as long as the cost
  //! falls by more than `least_gain`.
  //! \param may_enter  n
  void exchange(Index count, double least_gain, const std::vector<bool>& may_enter,
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
  void find_newcomers(const std::vector<bool>& may_enter, const PointWeights& weights);

  ActiveSetQp<Dim> qp_;
  std::vector<Candidate> newcomers_, removals_;
  std::vector<Index> support_;
  PointWeights trial_, least_, exchanged_;
};

}  // namespace flbc
