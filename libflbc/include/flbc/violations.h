// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Which properties of coordinates weights violate.
#pragma once

#include <string>
#include <vector>

#include "flbc/check.h"

namespace flbc {

//! Errors above this are violations of what coordinates must satisfy.
constexpr double kCheckTolerance = 1e-6;

//! What the weights violate of that which all coordinates of a cage satisfy: being finite, sum,
//! reproduction, Lagrange property and linearity on facets. Negative weights are no violation.
//! \return a sentence each, with place and value; empty if there are none
template <int Dim>
std::vector<std::string> find_violations(const WeightCheck<Dim>& check);

}  // namespace flbc
