// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Duals of the total variation that are no longer than phi.
#pragma once

#include <algorithm>
#include <cmath>

#include "flbc/distance_weights.h"

namespace flbc {

//! Shortens the rows that are longer than phi on a cell. Where most rows are zero it takes longer
//! to ask for phi than to see that. \param density  n x Dim
template <class Rows>
void shorten_to(const WeightFunctions& phi, Index cell, Rows& density) {
  Eigen::ArrayXd squared = density.col(0).array().square();
  for (Eigen::Index d = 1; d < density.cols(); ++d) squared += density.col(d).array().square();
  for (Eigen::Index i = 0; i < density.rows(); ++i) {
    if (squared[i] > 0) density.row(i) *= std::min(phi(i, cell) / std::sqrt(squared[i]), 1.0);
  }
}

}  // namespace flbc
