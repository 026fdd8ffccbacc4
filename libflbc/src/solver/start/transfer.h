// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Transfers duals to a start on another mesh of the same cage, or on the same mesh after a move.
#pragma once

#include <vector>

#include "flbc/cell_locator.h"
#include "flbc/lbc_problem.h"
#include "mesh/cell_walk.h"
#include "solver/start/duals.h"

namespace flbc {

//! The cells of a problem that contain points of another problem of the same cage. A point outside
//! by rounding belongs to the nearest cell.
template <int Dim>
std::vector<Location<Dim>> places_in(const LbcProblem<Dim>& problem, const PointList<Dim>& points) {
  return walk_to_points(problem.mesh, problem.topology, points);
}

//! Evaluates the duals of a coarse mesh on a fine mesh of the same cage. The meshes need not be
//! nested. Keeps references to all three arguments.
template <int Dim>
class Transfer {
 public:
  //! \param vertices  locations of the fine vertices in the coarse mesh, if known
  Transfer(const LbcProblem<Dim>& coarse, const Duals<Dim>& duals, const LbcProblem<Dim>& fine,
           std::vector<Location<Dim>> vertices = {});

  //! Transfers between two rest cages of one mesh, cell by cell. Flux densities are unchanged,
  //! because deforming them with their cells saves no iterations.
  static Transfer between_shapes(const LbcProblem<Dim>& before, const Duals<Dim>& duals,
                                 const LbcProblem<Dim>& after);

  //! Whether it was made by between_shapes().
  bool is_between_shapes() const { return between_shapes_; }

  //! The start on the fine mesh; it refers to this object. Weights are interpolated. The flux
  //! density is that of the coarse cell containing the fine centroid, made admissible.
  Start<Dim> start() const;

  //! The location of a fine vertex in the coarse mesh.
  const Location<Dim>& place_of(Index vertex) const { return vertices_[vertex]; }

  const DomainMesh<Dim>& coarse_mesh() const { return coarse_.mesh; }
  const SparseWeights& coarse_weights() const { return duals_.weights; }

 private:
  Transfer(const LbcProblem<Dim>& coarse, const Duals<Dim>& duals, const LbcProblem<Dim>& fine,
           bool between_shapes)
      : coarse_(coarse), duals_(duals), fine_(fine), between_shapes_(between_shapes) {}

  const LbcProblem<Dim>& coarse_;
  const Duals<Dim>& duals_;
  const LbcProblem<Dim>& fine_;
  const bool between_shapes_;
  std::vector<Location<Dim>> vertices_;
  std::vector<Index> cells_;  // coarse cells that contain the fine centroids
};

}  // namespace flbc
