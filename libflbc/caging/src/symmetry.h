// SPDX-License-Identifier: BSD-3-Clause
// Across which plane a model is symmetric.
#pragma once

#include "caging/mirror_plane.h"
#include "flbc/cage_from_model.h"

namespace flbc {

//! The plane that is asked for, through the middle of the model; for kAuto that to which the model
//! is most nearly symmetric, if it is.
template <int Dim>
MirrorPlane find_symmetry(const PointList<Dim>& points, const FacetList<Dim>& facets,
                          CageSymmetry wanted);

}  // namespace flbc
