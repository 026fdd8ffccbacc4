// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The nearest weights on few control points, in any metric.
#pragma once

#include <vector>

#include "flbc/types.h"
#include "sparsify/equality_qp.h"

namespace flbc {

//! The weights of one point that are not 0, and what they cost.
struct SparseRow {
  std::vector<Index> support{};   //!< ascending
  std::vector<double> weights{};  //!< > 0, in the order of the support
  double cost = 0;                //!< (w - t) . H (w - t) - t . H t
};

//! Minimises (w - t) . H (w - t) over w >= 0 with sum w = 1 and sum w c = x, for one point x and
//! target t at a time, on supports of few control points. Works to about 1e-8: results are to be
//! polished. Keeps its buffers: one per thread.
template <int Dim>
class MetricRow {
 public:
  //! \param metric  H, n x n, positive definite, kept by reference
  //! \param control_points  Dim x n, kept by reference \param size  a length to measure them by
  MetricRow(const Eigen::MatrixXd& metric, const PointList<Dim>& control_points, double size)
      : free_(metric, control_points, size) {}

  //! From here on for this point. \return H t, n, to be filled in
  Eigen::VectorXd& aim_at(const Vector<Dim>& point) { return free_.aim_at(point); }

  //! (w - t) . H (w - t) - t . H t, whatever row.cost says.
  double cost_of(const SparseRow& row) const;

  //! The nearest weights on the support. As a rule: if many become 0, others may be as near.
  //! \return false if none were found, or if surely none cost less than `bound`
  bool solve(const std::vector<Index>& support, double bound, SparseRow& row);

  //! Goes from feasible weights to the nearest ones on their support, to which a newcomer is added
  //! if it is >= 0. The cost never rises.
  void descend(SparseRow& row, Index newcomer = -1);

  //! Half the derivative of the cost by each weight, less what sum and reproduction absorb:
  //! negative where a weight would like to grow. \param row  as found by solve() or descend()
  //! \return n, zeros if rounding hides them
  const Eigen::VectorXd& slopes(const SparseRow& row);

  //! By how much the cost rises at least when an influence goes; exactly, if all others then stay
  //! positive. \param row  as found by solve() or descend() \return in the order of the support
  const std::vector<double>& removal_costs(const SparseRow& row);

 private:
  using Sums = typename FreeRow<Dim>::Sums;

  bool drop_negative(const std::vector<Index>& support, double bound);
  void descend_to_minimum();
  std::size_t step_to_free_minimum();
  std::size_t most_wanted() const;
  bool is_feasible() const;
  bool finish(SparseRow& row);

  FreeRow<Dim> free_;

  // Of the active set method: who takes part, and who does not at present.
  std::vector<Index> members_;
  std::vector<double> weights_;
  std::vector<Index> left_;

  SparseRow lower_;
  Eigen::VectorXd slopes_;
  std::vector<double> removal_costs_;
  std::vector<std::size_t> order_;
};

}  // namespace flbc
