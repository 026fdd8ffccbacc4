// SPDX-License-Identifier: BSD-3-Clause
#include "support/simplex.h"

#include <Eigen/QR>

namespace flbc::testing {

// Compiled separately, because it takes longer to compile than its users.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

}  // namespace flbc::testing
