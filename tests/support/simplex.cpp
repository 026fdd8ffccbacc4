// SPDX-License-Identifier: BSD-3-Clause
#include "support/simplex.h"

#include <Eigen/QR>

namespace flbc::testing {

// Apart from what uses it, because it takes longer to compile than all of that.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

}  // namespace flbc::testing
