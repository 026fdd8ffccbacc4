// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Whether two files have the same vertices, which their numbers alone do not say.
#pragma once

#include <string>
#include <vector>

#include "flbc/io/model.h"

namespace flbc::io {

//! The vertices of one file that are those of another.
struct SameVertices {
  std::vector<Index> numbers{};  //!< in the second file, by vertex of the first
  bool are_renumbered = false;   //!< whether any number differs
};

//! Finds which vertex of `pose` is which vertex of `rest`, by the polygons that join them. The
//! numbers stay if both files have the same polygons, or divide the same polygons in other ways,
//! such as quadrangles and triangles. Otherwise the vertices are matched so that the polygons are
//! the same; where several matches are possible, each connected part takes the one that moves its
//! vertices least. A pose without polygons keeps its numbers.
//! \param rest_name, pose_name  of the files, for messages
//! \throws InputError if the numbers of vertices differ; if the polygons differ, naming the first
//! one; if two matches move the vertices equally far
SameVertices find_same_vertices(const PolygonSoup& rest, const std::string& rest_name,
                                const PolygonSoup& pose, const std::string& pose_name);

}  // namespace flbc::io
