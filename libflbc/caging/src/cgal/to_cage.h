// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CGAL/Surface_mesh.h>

#include "flbc/cage.h"

namespace flbc {

//! A triangle mesh of CGAL without gaps in its numbers.
template <class Point>
Cage<3> to_cage(const CGAL::Surface_mesh<Point>& surface) {
  Cage<3> cage{PointList<3>(3, surface.number_of_vertices()),
               FacetList<3>(3, surface.number_of_faces())};
  for (const auto vertex : surface.vertices()) {
    const auto& p = surface.point(vertex);
    cage.points.col(vertex.idx()) << p.x(), p.y(), p.z();
  }
  for (const auto face : surface.faces()) {
    int k = 0;
    for (const auto vertex : vertices_around_face(surface.halfedge(face), surface)) {
      cage.facets(k++, face.idx()) = static_cast<Index>(vertex.idx());
    }
  }
  return cage;
}

}  // namespace flbc
