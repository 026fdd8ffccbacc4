// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! OBJ and OFF files with other coordinates and everything else as it was.
#pragma once

#include <array>
#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

#include "flbc/io/polygon_file.h"

namespace flbc::io {

//! The text of an OBJ or OFF file in which the coordinates of the vertices can be exchanged.
//! Polygons, texture coordinates, groups, materials, colours and comments stay byte by byte.
class PolygonText {
 public:
  //! Reads a file ending in .obj or .off. \throws IoError; InputError naming file and line, as
  //! read_obj() and read_off() do; OptionError for another extension
  explicit PolygonText(const std::string& path);

  //! What the file holds.
  const PolygonSoup& soup() const { return soup_; }

  //! Number of normals in the file that belong to no polygon with an area: they cannot follow the
  //! vertices, and write() leaves them as they are.
  Index num_loose_normals() const { return num_loose_normals_; }

  //! Writes the text with each vertex moved to its column of `points` (Dim x number of vertices),
  //! with the digits it takes to read the same numbers back. In 2D z and the normals stay. In 3D a
  //! normal turns as the area-weighted mean of the polygons at the corners that refer to it does,
  //! so that normals someone has chosen, or that point to the other side, remain so. \throws
  //! InputError if the number of points is another or one is not finite
  template <int Dim>
  void write(std::ostream& out, const PointList<Dim>& points) const;

 private:
  // Where a number stands in the text; empty where a vertex has no z.
  struct Span {
    std::size_t begin;
    std::size_t size;
  };
  struct Triple {
    std::array<Span, 3> spans;
    bool is_normal;
    Index index;  // of the vertex or of the normal
  };
  class Scanner;

  std::vector<Vector<3>> compute_normals(const std::vector<Vector<3>>& points) const;

  std::string text_;
  PolygonSoup soup_;
  std::vector<Triple> triples_;                     // in the order of the text
  std::vector<Vector<3>> normals_;                  // as the file has them
  std::vector<std::vector<Index>> corner_normals_;  // by polygon and corner, -1 = none
  std::vector<Vector<3>> rest_normals_;             // of the polygons as the file has them
  Index num_loose_normals_ = 0;
};

}  // namespace flbc::io
