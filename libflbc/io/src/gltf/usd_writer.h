// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Writes the same skins as text of Universal Scene Description.
#pragma once

#include <string>

#include "gltf/glb_writer.h"

namespace flbc::gltf {

//! Makes the content of a .usda file: a SkelRoot "model" with the mesh "surface", the skeleton
//! "cage" and, if something moves, its animation "poses". Its joints are a root "cage", which never
//! moves, and its children, the control points. Influences are not limited to sets of four.
std::string encode_usda(const GlbScene& scene);

}  // namespace flbc::gltf
