// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Reading surface meshes through OpenMesh without the losses of a half-edge mesh on the way.
#pragma once

#include <string>

#include "flbc/io/polygon_file.h"

namespace flbc::openmesh {

//! Reads .ply (by a reader of our own, exactly, because OpenMesh's crashes on damaged files) and
//! any other format OpenMesh reads. Polygons stay polygons, and faces that no half-edge mesh could
//! hold (non-manifold edges) are kept, so that a cage's defects can be named instead of vanishing.
//! OpenMesh's readers keep single precision only, except for .om files with double points; read
//! .obj and .off exactly with io::read_obj and io::read_off. Corners of .stl files are merged where
//! they coincide. A damaged .om file can crash OpenMesh's reader: read only ones you trust.
//! \throws IoError if the file cannot be opened, InputError if it makes no sense
io::PolygonSoup read_polygons(const std::string& path);

}  // namespace flbc::openmesh
