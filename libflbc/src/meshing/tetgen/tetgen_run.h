// SPDX-License-Identifier: BSD-3-Clause
// Runs TetGen, and hides its types.
#pragma once

#include <string>
#include <vector>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "meshing/isolated_process.h"

namespace flbc {

//! A piecewise linear complex, the input of TetGen.
struct TetgenInput {
  PointList<3> points;     //!< control points, then points without a facet
  FacetList<3> triangles;  //!< indices of points
  PointList<3> holes;      //!< a point in each region to leave empty
};

//! The output of TetGen. Points without a cell are kept, so input points keep their indices.
struct TetgenOutput {
  DomainMesh<3> mesh;
  std::vector<Index> regions;  //!< per cell, the index of its region; facets separate regions
};

//! Runs TetGen in the units of DecimalUnit(input.points), to which volumes in switches refer.
//! \param switches  of TetGen, for example "pq1.414QJA"
//! \throws InputError if TetGen fails, crashes, or exceeds the time limit
TetgenOutput run_tetgen(const TetgenInput& input, const std::string& switches,
                        const Patience& patience);

}  // namespace flbc
