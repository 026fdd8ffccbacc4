// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Writing OpenMesh's own files.
#pragma once

#include <string>

#include "flbc/io/model_file.h"

namespace flbc::openmesh {

//! Writes an .om file with points and normals in double precision, colours in 256 levels and
//! texture coordinates in single precision, each per vertex; io::losses() tells what is left out.
//! Vertices and polygons keep their numbers. \throws IoError; InputError naming a polygon that
//! OpenMesh's half-edge mesh cannot hold: more than two polygons meet at an edge, neighbours do not
//! have the same orientation, or a vertex occurs twice
void write_om(const std::string& path, const io::Model& model);

}  // namespace flbc::openmesh
