// SPDX-License-Identifier: BSD-3-Clause
// Finds the cell size at which a mesher gives the target number of vertices.
#pragma once

#include <cmath>
#include <functional>
#include <utility>

#include "flbc/domain_mesh.h"
#include "flbc/nested_mesh.h"

namespace flbc {

template <int Dim>
struct VertexCountGoal {
  Index vertices;      //!< wanted, > 0
  double good_enough;  //!< relative error at which the search ends
  //! Whether the count is that after refine(), of a coarser mesh.
  bool refines = false;

  //! \param coarsest  the mesh with the fewest vertices \return a goal for coarser meshes, if the
  //! coarsest is not too fine
  static VertexCountGoal of(Index vertices, double good_enough, const DomainMesh<Dim>& coarsest) {
    return {vertices, good_enough, refined_vertices(coarsest) <= (1 + good_enough) * vertices};
  }

  //! Roughly the number of vertices of the mesh before refine().
  Index before_refining() const { return refines ? vertices / (Dim == 2 ? 4 : 7) : vertices; }

  double count(const DomainMesh<Dim>& mesh) const {
    return refines ? refined_vertices(mesh) : mesh.num_vertices();
  }
  double error(double count) const { return std::abs(count / vertices - 1); }
  bool is_met(const DomainMesh<Dim>& mesh) const { return error(count(mesh)) <= good_enough; }

  //! The mesh with the wanted vertices. \param mesh  found, finished
  DomainMesh<Dim> result(DomainMesh<Dim> mesh) const {
    return refines ? refine(mesh) : std::move(mesh);
  }
};

//! Secant search in the logarithms of count and bound, within the current bracket.
//! \param best         best known mesh
//! \param first_bound  of cell length, area, or volume; > 0
//! \param exponent     count ~ bound^-exponent, roughly
//! \param make_mesh    runs the mesher with a bound, at most `max_runs` times
//! \return the mesh with the count nearest to the target, possibly `best`
template <int Dim>
DomainMesh<Dim> search_vertex_count(const VertexCountGoal<Dim>& goal, DomainMesh<Dim> best,
                                    double first_bound, double exponent,
                                    const std::function<DomainMesh<Dim>(double)>& make_mesh,
                                    int max_runs = 12);

}  // namespace flbc
