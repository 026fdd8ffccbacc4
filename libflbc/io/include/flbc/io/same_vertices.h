// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Whether two files have the same vertices, which their numbers alone do not say.
#pragma once

#include <string>

#include "flbc/io/model.h"

namespace flbc::io {

//! Checks that vertices with equal numbers are the same in both files, by the polygons that join
//! them. Both files have the same polygons, or divide them in other ways, such as quadrangles into
//! triangles. A pose without polygons passes.
//! \param rest_name, pose_name  of the files, for messages
//! \throws InputError if the numbers of vertices differ, or the polygons, naming the first one
void check_same_vertices(const PolygonSoup& rest, const std::string& rest_name,
                         const PolygonSoup& pose, const std::string& pose_name);

}  // namespace flbc::io
