// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Exact reading of OBJ and OFF text: coordinates stay double, faces stay polygons, and nothing is
//! repaired or dropped on the way.
#pragma once

#include <string>
#include <vector>

#include "flbc/types.h"

namespace flbc::io {

//! A file's points, polylines and polygons as they stand, indices from 0.
struct PolygonSoup {
  std::vector<Vector<3>> points;             //!< missing third coordinates are 0
  std::vector<std::vector<Index>> polygons;  //!< vertices in order, the first not repeated
  std::vector<std::vector<Index>>
      polylines;  //!< vertices in order; closed if the last is the first
};

//! Reads `v`, `f` and `l` lines (negative indices and v/vt/vn triples included) and ignores the
//! rest. \throws IoError, InputError naming file and line
PolygonSoup read_obj(const std::string& path);

//! Reads OFF (also COFF, NOFF, STOFF headers; comments; colours are ignored).
//! \throws IoError, InputError naming file and line
PolygonSoup read_off(const std::string& path);

//! Writes OBJ with 17 digits, so that coordinates survive. \throws IoError; InputError if one is
//! not finite
void write_obj(const std::string& path, const PolygonSoup& soup);

//! Writes OFF with 17 digits (polygons only). \throws IoError; InputError if a coordinate is not
//! finite
void write_off(const std::string& path, const PolygonSoup& soup);

}  // namespace flbc::io
