// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Duals of the total variation that are no longer than phi.
#pragma once

#include <limits>

#include "flbc/types.h"

namespace flbc {

//! Shortens the rows that are longer than phi. \param phi  n \param density  n x Dim
template <class Lengths, class Rows>
void shorten_to(const Lengths& phi, Rows& density) {
  const Eigen::ArrayXd length =
      density.rowwise().norm().array().max(std::numeric_limits<double>::min());
  density.array().colwise() *= (phi.array() / length).min(1);
}

}  // namespace flbc
