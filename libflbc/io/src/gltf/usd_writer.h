// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The same skins as plain text of Universal Scene Description.
#pragma once

#include <string>

#include "gltf/glb_writer.h"

namespace flbc::gltf {

//! The content of a .usda file: a SkelRoot "model" with the mesh "surface", the skeleton "cage" and,
//! if something moves, its animation "poses". Its joints are a root "cage", which never moves, and
//! its children, the control points. Influences per vertex are not limited to sets of four.
std::string encode_usda(const GlbScene& scene);

}  // namespace flbc::gltf
