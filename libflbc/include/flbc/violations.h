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

//! Properties of all coordinates of a cage that the weights lack: being finite, partition of unity,
//! reproduction, Lagrange property and linearity on facets. Negative weights are no violation.
//! \param check  as check_weights() gives it
//! \return a sentence each, with place and value; empty if there are none
template <int Dim>
std::vector<std::string> find_violations(const WeightCheck<Dim>& check);

}  // namespace flbc
