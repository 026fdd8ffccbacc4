// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The state of an iteration in a form that other meshes of the same cage understand.
#pragma once

#include "flbc/sparse_weights.h"
#include "flbc/types.h"
#include "solver/warm_start/flux_densities.h"

namespace flbc {

//! The state of an iteration on a mesh, expressed by quantities that have a limit as meshes become
//! finer: densities and potentials in place of numbers per cell and facet. Lengths are those of the
//! problem, whose domain is scaled. n control points, V vertices, F cells, E facets.
template <int Dim>
struct MeshState {
  //! Components of the potential: a stream function in 2D, a vector potential in 3D.
  static constexpr int kPotentialSize = Dim == 2 ? 1 : 3;

  double penalty = 0;                 //!< used last
  SparseWeights weights{};            //!< of V points
  FluxDensities<Dim> flux_density{};  //!< p_s / A_s, at most phi long

  //! Method::kValue: q - w of the constraint u = w, u >= 0, without its zeros, of V points; for the
  //! penalty above. No points without the constraint.
  SparseWeights vertex_dual{};

  //! Method::kGradient: potential of the flux at the middle of each facet, n x (kPotentialSize E).
  Eigen::MatrixXd potential;

  //! Method::kGradient: factors of the harmonic fields that belong to holes, n x P.
  Eigen::MatrixXd periods;
};

}  // namespace flbc
