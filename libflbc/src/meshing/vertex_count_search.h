// SPDX-License-Identifier: BSD-3-Clause
// Finds the cell size with which a mesher gives the number of vertices wanted.
#pragma once

#include <cmath>
#include <functional>

#include "flbc/domain_mesh.h"

namespace flbc {

struct VertexCountGoal {
  Index vertices = 0;         //!< wanted
  double good_enough = 0.02;  //!< relative error with which the search ends
  int max_runs = 12;          //!< of the mesher

  double error(Index count) const { return std::abs(double(count) / double(vertices) - 1); }
  bool is_met(Index count, double tolerance) const { return error(count) <= tolerance; }
};

//! Secant search in the logarithms of count and bound, kept within the bracket found so far.
//! \param best         the nearest mesh known beforehand
//! \param first_bound  of cells' lengths, areas or volumes; > 0
//! \param exponent     count ~ bound^-exponent, roughly
//! \param make_mesh    runs the mesher with a bound
//! \return the mesh whose count is nearest to the goal, which may be `best`
template <int Dim>
DomainMesh<Dim> search_vertex_count(const VertexCountGoal& goal, DomainMesh<Dim> best,
                                    double first_bound, double exponent,
                                    const std::function<DomainMesh<Dim>(double)>& make_mesh);

}  // namespace flbc
