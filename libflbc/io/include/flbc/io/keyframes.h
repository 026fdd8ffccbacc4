// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Reads animations of a cage from text files.
#pragma once

#include <string>
#include <vector>

#include "flbc/types.h"

namespace flbc::io {

//! A keyframe of an animation.
struct Keyframe {
  double time;                 //!< as in the file, usually in seconds
  PointList<3> displacements;  //!< 3 x n, of the control points from the rest cage
};

//! Reads keyframes. The file has a line `k TIME` per keyframe and a line `c KEYFRAME DX DY DZ` per
//! keyframe and control point. Keyframes are numbered from 0 in the order of their `k` lines; the
//! `c` lines of a keyframe are in the order of the control points. '#' starts a comment.
//! \throws IoError; InputError naming file and line, also if keyframe times decrease or numbers of
//! control points differ
std::vector<Keyframe> read_keyframes(const std::string& path);

}  // namespace flbc::io
