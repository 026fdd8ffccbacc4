// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Reading surface meshes through OpenMesh without the losses of a half-edge mesh on the way.
#pragma once

#include <string>

#include "flbc/io/model.h"

namespace flbc::openmesh {

//! Reads .ply and .om (by io::ModelFile, exactly, because OpenMesh's readers crash on damaged
//! files) and any other format OpenMesh reads. Polygons stay polygons, and faces that no half-edge
//! mesh could hold (non-manifold edges) are kept, so that a cage's defects can be named instead of
//! vanishing. OpenMesh's readers keep single precision only; read .obj and .off exactly with
//! io::read_polygons. Corners of .stl files are merged where they coincide.
//! \throws IoError if the file cannot be opened, InputError if it makes no sense
io::PolygonSoup read_polygons(const std::string& path);

}  // namespace flbc::openmesh
