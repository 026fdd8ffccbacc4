// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The colors of weights.
#pragma once

#include "draw/primitives.h"

namespace flbc::draw {

//! How far a weight may leave [0, 1] before it is shown as a defect.
constexpr double kWeightTolerance = 1e-3;

//! The color of a weight. From 0 to 1 it runs from near white through blue, green and ochre to
//! dark red and darkens all the way, so that the order survives printing in gray. Weights below
//! -kWeightTolerance are violet, those above 1 + kWeightTolerance magenta, the deeper the farther
//! out.
Color weight_color(double weight);

}  // namespace flbc::draw
