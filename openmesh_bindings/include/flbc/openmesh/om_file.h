// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Writes OpenMesh .om files.
#pragma once

#include <string>

#include "flbc/io/model_file.h"

namespace flbc::openmesh {

//! Writes an .om file with points and normals in double precision, colors in 256 levels, and
//! texture coordinates in single precision, each per vertex. io::losses() lists the attributes that
//! are lost. Vertices and polygons keep their indices. \throws IoError; InputError naming a polygon
//! that a half-edge mesh cannot represent: more than two polygons meet at an edge, neighbors have
//! different orientations, or a vertex occurs twice
void write_om(const std::string& path, const io::Model& model);

}  // namespace flbc::openmesh
