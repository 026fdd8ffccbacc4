// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From the state on one mesh to the start on another one of the same cage, or on the same mesh
//! after it has moved.
#pragma once

#include <vector>

#include "flbc/cell_locator.h"
#include "flbc/lbc_problem.h"
#include "solver/warm_start/flux_potential.h"
#include "solver/warm_start/mesh_state.h"

namespace flbc {

//! Fine length / coarse length.
template <int Dim>
double enlargement(const LbcProblem<Dim>& coarse, const LbcProblem<Dim>& fine);

//! Where points of the fine mesh's space lie in the coarse mesh's.
template <int Dim>
PointList<Dim> points_in_coarse(const LbcProblem<Dim>& coarse, const LbcProblem<Dim>& fine,
                                const PointList<Dim>& fine_points);

//! The coarse cells they lie in. Points that rounding puts outside belong to the cell next to them.
template <int Dim>
std::vector<Location<Dim>> places_in_coarse(const LbcProblem<Dim>& coarse,
                                            const LbcProblem<Dim>& fine,
                                            const PointList<Dim>& fine_points);

//! Evaluates a coarse mesh's state where the fine mesh needs it, in the lengths of the fine
//! problem. The meshes need not be nested, nor their problems scaled alike. Keeps references to all
//! three arguments.
template <int Dim>
class Transfer {
 public:
  //! \param vertices  places of the fine vertices in the coarse mesh, if known already
  Transfer(const LbcProblem<Dim>& coarse, const MeshState<Dim>& state, const LbcProblem<Dim>& fine,
           std::vector<Location<Dim>> vertices = {});

  //! Between two shapes of one mesh, where a cell stays the same cell and nothing is looked for.
  //! Flux densities stay as they are: turning and stretching them with their cells saves no
  //! iterations.
  static Transfer between_shapes(const LbcProblem<Dim>& before, const MeshState<Dim>& state,
                                 const LbcProblem<Dim>& after);

  //! Whether it was made by between_shapes().
  bool is_between_shapes() const { return between_shapes_; }

  //! The penalty that acts on the fine mesh as the coarse one's did there.
  double penalty() const { return enlargement_ * state_.penalty; }

  //! Interpolated, but exact on the boundary, n x V.
  WeightMatrix weights() const;

  //! The same at one interior vertex, n numbers.
  Eigen::VectorXd weights_at(Index vertex) const;

  //! Where a fine vertex lies in the coarse mesh.
  const Location<Dim>& place_of(Index vertex) const { return vertices_[vertex]; }

  //! The coarse mesh and the weights there.
  const DomainMesh<Dim>& coarse_mesh() const { return coarse_.mesh; }
  const SparseWeights& coarse_weights() const { return state_.weights; }

  //! In a fine cell: that of the coarse cell which contains its middle, no longer than phi. n x Dim
  Eigen::Matrix<double, Eigen::Dynamic, Dim> flux_density(Index cell) const;

  //! Interpolated, n x V; empty if there is none. \param penalty  of the fine iteration
  WeightMatrix vertex_dual(double penalty) const;

  //! The same on demand, one vertex at a time; null if there is none.
  VectorsAt<1> vertex_dual_at(double penalty) const;

  //! mu u on a fine facet's first side, n x Dim.
  Eigen::Matrix<double, Eigen::Dynamic, Dim> facet_multiplier(Index facet) const;

  //! n x P.
  Eigen::MatrixXd periods() const { return enlargement_ * state_.periods; }

 private:
  struct Unlocated {};
  Transfer(Unlocated, const LbcProblem<Dim>& coarse, const MeshState<Dim>& state,
           const LbcProblem<Dim>& fine);

  WeightMatrix at_vertices(const SparseWeights& coarse) const;

  const LbcProblem<Dim>& coarse_;
  const MeshState<Dim>& state_;
  const LbcProblem<Dim>& fine_;
  double enlargement_;
  bool between_shapes_ = false;
  std::vector<Location<Dim>> vertices_;
  std::vector<Index> cells_;           // the coarse ones that contain the middles of the fine ones
  std::vector<Location<Dim>> facets_;  // empty without potential
};

}  // namespace flbc
