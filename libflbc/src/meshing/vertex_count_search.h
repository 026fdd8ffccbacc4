// SPDX-License-Identifier: BSD-3-Clause
// Finds the cell size at which a mesher gives the target number of vertices.
#pragma once

#include <cmath>
#include <functional>

#include "flbc/domain_mesh.h"

namespace flbc {

struct VertexCountGoal {
  Index vertices = 0;         //!< wanted
  double good_enough = 0.02;  //!< relative error at which the search ends
  int max_runs = 12;          //!< of the mesher

  double error(Index count) const { return std::abs(double(count) / double(vertices) - 1); }
  bool is_met(Index count) const { return error(count) <= good_enough; }
};

//! Secant search in the logarithms of count and bound, within the current bracket.
//! \param best         best known mesh
//! \param first_bound  of cell length, area, or volume; > 0
//! \param exponent     count ~ bound^-exponent, roughly
//! \param make_mesh    runs the mesher with a bound
//! \return the mesh with the count nearest to the target, possibly `best`
template <int Dim>
DomainMesh<Dim> search_vertex_count(const VertexCountGoal& goal, DomainMesh<Dim> best,
                                    double first_bound, double exponent,
                                    const std::function<DomainMesh<Dim>(double)>& make_mesh);

}  // namespace flbc
