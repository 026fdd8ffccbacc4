// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The unit of penalties.
#pragma once

#include <cmath>

#include "flbc/options.h"

namespace flbc {

//! The penalty that has the value 1 for a cage of size 1, for a cage of another size. The term of
//! the penalty has to grow with lengths as total variation does, (length)^(dim - 1): it is
//! mu A |grad w|^2 for kValue, mu A^2 |grad w|^2 for kLbc2014 and mu |grad w|^2 for the others, in
//! which gradients shrink as 1 / length.
//! \param size  of the cage (bounding_box_diagonal)
inline double penalty_unit(Method method, int dim, double size) {
  const int measures = method == Method::kLbc2014 ? 2 : method == Method::kValue ? 1 : 0;
  return std::pow(size, dim + 1 - measures * dim);
}

}  // namespace flbc
