// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Comparing extremes found in parts of the points.
#pragma once

#include "flbc/check.h"

namespace flbc {

//! Takes the value if it is the first or larger; the first of equal ones stays.
template <int Dim>
void keep_larger(Extreme<Dim>& best, const Extreme<Dim>& other) {
  if (other.point >= 0 && (best.point < 0 || other.value > best.value)) best = other;
}

template <int Dim>
void keep_smaller(Extreme<Dim>& best, const Extreme<Dim>& other) {
  if (other.point >= 0 && (best.point < 0 || other.value < best.value)) best = other;
}

}  // namespace flbc
