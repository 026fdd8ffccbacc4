// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Slices seen from straight before them.
#pragma once

#include "draw/scene.h"

namespace flbc::draw {

//! Paints all slices of the scene in a row (if the strip is wider than high) or column, without
//! distortion and all at one scale, in the order in which they follow each other in the scene, from
//! the left or from the top.
void paint_panels(Canvas& canvas, const Scene& scene, const Box& strip, Index control_point);

}  // namespace flbc::draw
