// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Animations of a cage as text.
#pragma once

#include <string>
#include <vector>

#include "flbc/types.h"

namespace flbc::io {

//! A moment of an animation.
struct Keyframe {
  double time;                 //!< as the file has it, usually in seconds
  PointList<3> displacements;  //!< 3 x n, of the control points from where they rest
};

//! Reads keyframes: a line `k TIME` per keyframe, and a line `c KEYFRAME DX DY DZ` per keyframe and
//! control point. Keyframes are numbered from 0 in the order of their `k` lines; the `c` lines of a
//! keyframe are in the order of the control points. '#' starts a comment.
//! \throws IoError; InputError naming file and line, that a keyframe comes before the one above it,
//! or that it has another number of control points than the first one
std::vector<Keyframe> read_keyframes(const std::string& path);

}  // namespace flbc::io
