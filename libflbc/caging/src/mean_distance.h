// SPDX-License-Identifier: BSD-3-Clause
// How far a cage is from its model.
#pragma once

#include "caging/enclosure.h"
#include "flbc/cage.h"

namespace flbc {

//! Mean distance of the cage's surface (2D: lines) from the model, by points spread evenly over
//! every facet.
template <int Dim>
double mean_distance(const Cage<Dim>& cage, const Enclosure<Dim>& model);

}  // namespace flbc
