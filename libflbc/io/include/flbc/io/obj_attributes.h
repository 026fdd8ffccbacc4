// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What OBJ files hold for those who draw a model: texture coordinates, normals and colours.
#pragma once

#include <string>
#include <vector>

#include "flbc/io/polygon_file.h"

namespace flbc::io {

//! What a polygon's corner refers to beside its vertex; -1 = nothing.
struct CornerReferences {
  Index texture_coordinate = -1;
  Index normal = -1;
};

//! The attributes of a surface. All lists are empty where there are none.
struct SurfaceAttributes {
  PointList<2> texture_coordinates{};  //!< 2 x T, as in the file: the second one points up
  PointList<3> normals{};              //!< 3 x N, of any length
  //! 3 x P in [0, 1]; empty unless every vertex has a colour.
  PointList<3> colors{};
  std::vector<std::vector<CornerReferences>> corners{};  //!< by polygon and corner
};

//! Reads `vt` and `vn` lines, the corners of `f` lines, and red, green and blue after the
//! coordinates of vertices.
//! \param soup  what read_obj() made of the file
//! \throws IoError; InputError naming file and line, also if a `vt` or `vn` line is continued on
//! another one, which read_obj() takes for a line of its own
SurfaceAttributes read_obj_attributes(const std::string& path, const PolygonSoup& soup);

}  // namespace flbc::io
