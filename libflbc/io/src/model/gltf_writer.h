// SPDX-License-Identifier: BSD-3-Clause
// Meshes with materials and pictures in new glTF documents.
#pragma once

#include <string>
#include <vector>

#include "model/gltf_document.h"
#include "model/surface.h"

namespace flbc::io {

//! Adds the data, the materials in use, and their pictures. Triangles without a material get a matt
//! one, because viewers show polished metal otherwise.
//! \param positions  3 x S \param sources  S, written as _VERTEX; no column if they are not needed
//! \param left_out  gets pictures that cannot be read, one phrase each
//! \return the mesh, with one primitive per material
GltfJson add_mesh(GltfDocument& document, const gltf::Surface& surface,
                  const Eigen::Matrix3Xf& positions, const Eigen::RowVectorXf& sources,
                  std::vector<std::string>& left_out);

//! The bytes of the color texture of a material; empty if there is none.
//! \param left_out  gets a phrase if it cannot be read or is not a .png or .jpg
std::string load_picture(const Material& material, std::vector<std::string>& left_out);

}  // namespace flbc::io
