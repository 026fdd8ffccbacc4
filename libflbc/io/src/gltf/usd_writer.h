// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The same skins as plain text of Universal Scene Description.
#pragma once

#include <string>

#include "gltf/glb_writer.h"

namespace flbc::gltf {

//! The content of a .usda file: a SkelRoot "model" with the mesh "surface", the skeleton "cage"
//! whose joints are the control points, and if something moves its animation "poses". Its
//! influences per vertex are not limited to sets of four.
std::string encode_usda(const GlbScene& scene);

}  // namespace flbc::gltf
