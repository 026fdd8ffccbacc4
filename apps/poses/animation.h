// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Animations of a cage, from cage files or keyframes.
#pragma once

#include <string>

#include "gltf/skin.h"
#include "poses/poses.h"

namespace flbc::app {

//! A pose per file, `frames_per_second` of them in a second, the first one at 0.
//! \throws IoError; InputError if a file has not the number of control points of `rest` (Dim x n)
template <int Dim>
gltf::Animation<Dim> load_animation(const CageFiles& files, double frames_per_second,
                                    const PointList<Dim>& rest);

//! The keyframes of a file at their times, in seconds.
//! \throws IoError, InputError as load_keyframes()
template <int Dim>
gltf::Animation<Dim> load_animation(const std::string& keyframes, const PointList<Dim>& rest);

}  // namespace flbc::app
