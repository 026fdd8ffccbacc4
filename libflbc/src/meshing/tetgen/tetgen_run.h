// SPDX-License-Identifier: BSD-3-Clause
// One run of TetGen, whose types stay behind this file.
#pragma once

#include <string>
#include <vector>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"

namespace flbc {

//! A piecewise linear complex: what TetGen is to fill.
struct TetgenInput {
  PointList<3> points;     //!< the control points, then points of no facet
  FacetList<3> triangles;  //!< indices of points
  PointList<3> holes;      //!< a point in each region that is to stay empty
};

//! A mesh as TetGen leaves it: points of no cell are kept, so that input points keep their numbers.
struct TetgenOutput {
  DomainMesh<3> mesh;
  std::vector<Index> regions;  //!< per cell, numbers of the regions that the facets separate
};

//! \param switches    TetGen's, for example "pq1.414QJA"
//! \param time_limit  in seconds
//! \throws InputError if TetGen fails, crashes, or takes longer
TetgenOutput run_tetgen(const TetgenInput& input, const std::string& switches, double time_limit);

}  // namespace flbc
