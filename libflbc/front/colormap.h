// SPDX-License-Identifier: BSD-3-Clause
// The colors of weights.
#pragma once

#include "front/primitives.h"

namespace flbc::draw {

//! Weights this close to 0 are no influence, and this far outside [0, 1] they are a defect.
constexpr double kWeightTolerance = 1e-4;

//! The color of a weight. No influence is near white. Positive weights run from pale green through
//! teal to dark blue and darken all the way, so that the order survives printing in gray and every
//! common kind of color blindness. Weights below -kWeightTolerance are orange, those above
//! 1 + kWeightTolerance magenta, the deeper the farther out.
Color weight_color(double weight);

}  // namespace flbc::draw
