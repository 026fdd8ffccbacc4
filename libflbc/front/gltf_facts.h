// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What is in a glTF file.
#pragma once

#include <string>
#include <vector>

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

//! Warns of what a result does not have of a model. \param phrases  one for each part
void warn_left_out(const std::string& result, const std::string& model,
                   const std::vector<std::string>& phrases);

}  // namespace flbc::app
