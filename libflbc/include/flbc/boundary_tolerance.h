// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The one tolerance for points that lie beside a cage or a hull by a hair.
#pragma once

namespace flbc {

//! Points outside a cage, its mesh or the hull of its control points by no more than this part of
//! the size (bounding_box_diagonal) count as lying on the boundary: files have few digits. Farther
//! ones are outside.
constexpr double kBoundaryTolerance = 1e-6;

}  // namespace flbc
