// SPDX-License-Identifier: BSD-3-Clause
// Closed surfaces (2D: lines) round a model, finer than a cage needs to be.
#pragma once

#include "caging/enclosure.h"
#include "flbc/cage.h"

namespace flbc {

//! How a wrap follows the model.
struct WrapSize {
  double alpha;   //!< gaps and hollows narrower than this are bridged
  double offset;  //!< distance from the model
};

//! Alpha wrapping of Portaneri et al. ("Alpha wrapping with an offset", 2022), by CGAL.
//! \return normals outwards; without facets if nothing could be wrapped
Cage<3> wrap(const Enclosure<3>& model, const WrapSize& size);

//! Outline of the cells of a grid that are nearer to the model than the offset. What it surrounds
//! is filled. \return counter-clockwise
Cage<2> wrap(const Enclosure<2>& model, const WrapSize& size);

}  // namespace flbc
