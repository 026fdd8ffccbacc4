// SPDX-License-Identifier: BSD-3-Clause
// A skin in words.
#pragma once

#include <string>

#include "gltf/skin.h"

namespace flbc::app {

//! "48 vertices, 92 triangles, 24 joints, .., at most 4 influences per vertex; .."
//! \param animation  of the skin \param size  of the model
template <int Dim>
std::string describe_skin(const gltf::ExportedSkin& skin, const gltf::Animation<Dim>& animation,
                          double size);

}  // namespace flbc::app
