// SPDX-License-Identifier: BSD-3-Clause
// Boxes and simplices, for models that nothing else encloses with so few control points.
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "flbc/cage.h"

namespace flbc {

//! A box and a simplex round the given box, symmetric to its middle across every axis (the box) or
//! not at all (the simplex). \param offset  between it and them
template <int Dim>
std::vector<Cage<Dim>> simple_cages(const Eigen::AlignedBox<double, Dim>& around, double offset);

}  // namespace flbc
