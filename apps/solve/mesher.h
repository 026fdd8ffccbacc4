// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Which program fills a cage with cells.
#pragma once

#include <string>

namespace flbc::app {

enum class Mesher {
  kAuto,    //!< CGAL in 2D; in 3D TetGen, and Netgen for cages on which that fails
  kCgal,
  kTetgen,
  kNetgen,
  kGiven    //!< none: the mesh was read from a file
};

//! Who makes meshes, and for how long.
struct MesherSettings {
  Mesher mesher = Mesher::kAuto;
  double timeout = 60;  //!< seconds that a run may take in 3D
};

inline const char* name_of(Mesher mesher) {
  constexpr const char* kNames[] = {"auto", "cgal", "tetgen", "netgen", "none"};
  return kNames[static_cast<int>(mesher)];
}

}  // namespace flbc::app
