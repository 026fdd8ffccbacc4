// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The pictures of flbc run.
#pragma once

#include "run/steps.h"

namespace flbc::app {

//! function.png: one coordinate function on the mesh, in 3D on slices. With poses also
//! deformation.png: what the cage moves at rest and in the pose where it moves farthest; without
//! them model.png: what it will move, coloured by that function.
template <int Dim>
void draw_pictures(Run<Dim>& run);

}  // namespace flbc::app
