// SPDX-License-Identifier: BSD-3-Clause
// Materials and images of a surface for glTF.
#pragma once

#include <string>
#include <vector>

#include "gltf/surface.h"

namespace flbc::gltf {

struct Picture {
  std::string media_type{};  //!< "image/png" or "image/jpeg"
  std::string bytes{};
};

//! A material and the index of its image.
struct LookMaterial {
  io::Material material{};
  int picture = -1;  //!< -1 = none
};

//! The appearance of all triangles.
struct Look {
  std::vector<LookMaterial> materials{};    //!< materials in use
  std::vector<Index> triangle_materials{};  //!< per triangle, -1 = none; empty if all have none
  std::vector<Picture> pictures{};
  std::vector<std::string> left_out{};  //!< missing items, one phrase each
};

//! Reads the images. A missing image is not an error.
Look look_of(const Surface& surface);

}  // namespace flbc::gltf
