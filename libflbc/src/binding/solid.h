// SPDX-License-Identifier: BSD-3-Clause
// Solid regions of a model: each moves by one affine map.
#pragma once

#include <string>
#include <vector>

#include "flbc/binding.h"

namespace flbc {

//! Checks the solid regions of a binding, whose weights may be missing.
//! \throws InputError naming the region if numbers are out of range, regions overlap or have points
//! outside the cage, the binding is mirrored, or no weights >= 0 move a region by one affine map;
//! then also with its size and a cure
template <int Dim>
void require_solid(const Binding<Dim>& binding);

//! Replaces the weights of the regions by the nearest affine ones, and blends those of a band
//! around them. Masked weights stay 0; a control point that is masked at a point of a region moves
//! none of its points.
template <int Dim>
void make_solid(Binding<Dim>& binding);

//! The weights of a solid binding with at most so many influences in each region, the same ones for
//! all of its points. \throws InputError naming the region if so few do not surround it
template <int Dim>
SparseWeights with_few_in_solid(const Binding<Dim>& binding, Index most);

//! About solid regions; empty if there are none.
std::string note_on_solid(const std::vector<std::vector<Index>>& solid);

}  // namespace flbc
