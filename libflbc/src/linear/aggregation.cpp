// SPDX-License-Identifier: BSD-3-Clause
#include "linear/aggregation.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace flbc {
namespace {

// Weaker couplings, relative to the diagonal, do not form groups.
constexpr double kStrong = 0.02;

class StrongCouplings {
 public:
  explicit StrongCouplings(const RowMatrix& matrix)
      : matrix_(matrix), diagonal_(kStrong * matrix.diagonal()) {}

  template <class Action>
  void for_each(Index row, const Action& action) const {
    for (RowMatrix::InnerIterator it(matrix_, row); it; ++it) {
      const auto column = static_cast<Index>(it.col());
      if (column == row) continue;
      if (it.value() * it.value() <= diagonal_[row] * diagonal_[column]) continue;
      action(column, std::abs(it.value()));
    }
  }

 private:
  const RowMatrix& matrix_;
  Eigen::VectorXd diagonal_;  // times kStrong
};

constexpr Index kNone = -1;

// Forms groups of an unknown and all unknowns coupled to it, if all are ungrouped.
void found_groups(const StrongCouplings& couplings, std::vector<Index>& group, Index& num_groups) {
  for (Index row = 0; row < static_cast<Index>(group.size()); ++row) {
    bool free = group[row] == kNone;
    couplings.for_each(row, [&](Index column, double) { free = free && group[column] == kNone; });
    if (!free) continue;
    group[row] = num_groups;
    couplings.for_each(row, [&](Index column, double) { group[column] = num_groups; });
    ++num_groups;
  }
}

// The rest joins the aggregate with the strongest coupling.
void join_groups(const StrongCouplings& couplings, std::vector<Index>& group) {
  const std::vector<Index> founded = group;
  for (Index row = 0; row < static_cast<Index>(group.size()); ++row) {
    if (group[row] != kNone) continue;
    double strongest = 0;
    couplings.for_each(row, [&](Index column, double coupling) {
      if (founded[column] == kNone || coupling <= strongest) return;
      strongest = coupling;
      group[row] = founded[column];
    });
  }
}

void group_the_rest(const StrongCouplings& couplings, std::vector<Index>& group,
                    Index& num_groups) {
  for (Index row = 0; row < static_cast<Index>(group.size()); ++row) {
    if (group[row] != kNone) continue;
    group[row] = num_groups;
    couplings.for_each(row, [&](Index column, double) {
      if (group[column] == kNone) group[column] = num_groups;
    });
    ++num_groups;
  }
}

}  // namespace

RowMatrix smoothed_prolongation(const RowMatrix& matrix) {
  const StrongCouplings couplings(matrix);
  std::vector<Index> group(matrix.rows(), kNone);  // of each unknown
  Index num_groups = 0;
  found_groups(couplings, group, num_groups);
  join_groups(couplings, group);
  group_the_rest(couplings, group, num_groups);
  const Eigen::VectorXd diagonal = matrix.diagonal();
  // Gershgorin bound of the largest eigenvalue of D^-1 A.
  Eigen::VectorXd bounds = Eigen::VectorXd::Zero(matrix.rows());
  parallel_for(static_cast<Index>(matrix.rows()), [&](Index row) {
    for (RowMatrix::InnerIterator it(matrix, row); it; ++it) bounds[row] += std::abs(it.value());
    bounds[row] /= diagonal[row];
  });
  const double omega = 4 / (3 * std::min(bounds.lpNorm<Eigen::Infinity>(), 2.0));

  return assemble_rows(static_cast<Index>(matrix.rows()), num_groups,
                       [&](Index row, const auto& add) {
                         add(group[row], 1.0);
                         for (RowMatrix::InnerIterator it(matrix, row); it; ++it) {
                           add(group[it.col()], -omega * it.value() / diagonal[row]);
                         }
                       });
}

RowMatrix coarse_matrix(const RowMatrix& matrix, const RowMatrix& prolongation) {
  const RowMatrix restriction = prolongation.transpose();
  return product(restriction, product(matrix, prolongation));
}

}  // namespace flbc
