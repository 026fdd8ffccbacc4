// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What is in a glTF file.
#pragma once

#include <string>

#include "flbc/io/files.h"

namespace flbc::app {

//! Whether a path ends in .glb, .gltf, or .vrm.
inline bool is_gltf_file(const std::string& path) {
  const auto extension = io::extension_of(path);
  return extension == "glb" || extension == "gltf" || extension == "vrm";
}

//! Counts of vertices, triangles, joints, and influences, and the length of the animation, as lines
//! for a terminal. \throws IoError, InputError
std::string describe_gltf(const std::string& path);

}  // namespace flbc::app
