// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Which few control points carry a point best, in any metric.
#pragma once

#include <vector>

#include "sparsify/active_set_qp.h"

namespace flbc {

//! Improves the support of a row of weights by moves that are tried one after the other. Keeps its
//! buffers: one per thread.
template <int Dim>
class MetricSearch {
 public:
  //! \param row  computes the weights, kept by reference
  //! \param metric  H, n x n, kept by reference
  MetricSearch(MetricRow<Dim>& row, const Eigen::MatrixXd& metric) : row_(row), metric_(metric) {}

  //! Removes influences, each time the one whose removal costs least, until `count` are left.
  //! \param row  as MetricRow gave it; of no use any more if the result is false
  //! \return false if no weights were found that cost less than `bound`
  bool reduce(Index count, double bound, SparseRow& row);

  //! Takes the weights on another support, ascending, if they cost less by more than `least_gain`.
  void adopt(const std::vector<Index>& support, double least_gain, SparseRow& row);

  //! Lets single influences in, for others if there are more than `count`, as long as the cost
  //! falls by more than `least_gain`. \param may_enter  n
  void exchange(Index count, double least_gain, const std::vector<bool>& may_enter, SparseRow& row);

 private:
  struct Candidate {
    double cost;
    Index number;
  };

  bool remove_cheapest(double bound, SparseRow& row);
  bool exchange_one(Index count, double least_gain, SparseRow& row);
  void find_newcomers(const std::vector<bool>& may_enter, const SparseRow& row);

  MetricRow<Dim>& row_;
  const Eigen::MatrixXd& metric_;
  std::vector<Candidate> newcomers_, removals_;
  std::vector<Index> support_;
  SparseRow trial_, least_, exchanged_;
};

}  // namespace flbc
