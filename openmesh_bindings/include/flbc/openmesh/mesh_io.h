// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Reads surface meshes with OpenMesh, without the restrictions of a half-edge mesh.
#pragma once

#include <string>

#include "flbc/io/model.h"

namespace flbc::openmesh {

//! Reads all formats of OpenMesh. Polygons are not triangulated. Faces that a half-edge mesh cannot
//! represent (non-manifold edges) are kept, so defects of a cage can be reported. io::ModelFile
//! reads .ply and .om exactly, because the OpenMesh readers crash on damaged files. Other formats
//! have single precision; use io::read_polygons() to read .obj and .off exactly. Coincident corners
//! of .stl files are merged.
//! \throws IoError if the file cannot be opened; InputError if it is malformed
io::PolygonSoup read_polygons(const std::string& path);

}  // namespace flbc::openmesh
