// SPDX-License-Identifier: BSD-3-Clause
// Closed surfaces (2D: lines) around a model, finer than the final cage.
#pragma once

#include "caging/enclosure.h"
#include "flbc/cage.h"

namespace flbc {

//! Options of a wrap.
struct WrapSize {
  double alpha;   //!< narrower gaps and hollows are bridged
  double offset;  //!< distance from the model
};

//! Alpha wrapping of Portaneri et al. ("Alpha wrapping with an offset", 2022), by CGAL.
//! \return outward normals; no facets if wrapping failed
Cage<3> wrap(const Enclosure<3>& model, const WrapSize& size);

//! Boundary of the grid cells within the offset of the model. Enclosed cells are filled. \return
//! counterclockwise
Cage<2> wrap(const Enclosure<2>& model, const WrapSize& size);

}  // namespace flbc
