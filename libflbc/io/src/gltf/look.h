// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Materials and pictures of a surface as glTF has them.
#pragma once

#include <string>
#include <vector>

#include "gltf/surface.h"

namespace flbc::gltf {

//! A file of a picture.
struct Picture {
  std::string media_type{};  //!< "image/png" or "image/jpeg"
  std::string bytes{};
};

//! A material and the number of its picture.
struct LookMaterial {
  io::Material material{};
  int picture = -1;  //!< -1 = none
};

//! All that triangles look like.
struct Look {
  std::vector<LookMaterial> materials{};    //!< those that some triangle has
  std::vector<Index> triangle_materials{};  //!< by triangle, -1 = none; empty if all have none
  std::vector<Picture> pictures{};
  std::vector<std::string> left_out{};      //!< what is missing, a phrase each
};

//! Reads the pictures. Never throws for one that cannot be had: that is no reason to refuse a model.
Look look_of(const Surface& surface);

}  // namespace flbc::gltf
