// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! PLY files, read without OpenMesh, whose reader hangs or crashes on damaged ones.
#pragma once

#include <string>

#include "flbc/io/polygon_file.h"

namespace flbc::openmesh {

//! Reads points and polygons of ASCII and binary PLY files and passes over everything else.
//! \throws IoError, InputError naming file and line or byte
io::PolygonSoup read_ply(const std::string& path);

}  // namespace flbc::openmesh
