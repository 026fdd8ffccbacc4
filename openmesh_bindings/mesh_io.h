// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Reading surface meshes through OpenMesh without the losses of a half-edge mesh on the way.
#pragma once

#include <string>

#include "flbc/io/polygon_file.h"

namespace flbc::openmesh {

//! Reads any format OpenMesh reads (.ply, .stl, .om, .obj, .off). Polygons stay polygons, and faces
//! that no half-edge mesh could hold (non-manifold edges) are kept, so that a cage's defects can be
//! named instead of vanishing. Coordinates pass through OpenMesh's readers, which keep single
//! precision only, except for .om files with double points; read .obj and .off exactly with
//! io::read_obj and io::read_off. Corners of .stl files are merged where they coincide.
//! \throws IoError if the file cannot be opened, InputError if OpenMesh cannot make sense of it
io::PolygonSoup read_polygons(const std::string& path);

}  // namespace flbc::openmesh
