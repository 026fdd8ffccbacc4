// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Solving on coarser meshes of the same cage first, to start from there.
#pragma once

#include <functional>

#include "flbc/solver.h"

namespace flbc {

//! Makes a mesh of the cage's interior with about so many vertices, as triangulate() and
//! tetrahedralize() do (meshing.h). The cage is scaled, the mesh has to fill it as it is.
template <int Dim>
using CoarseMesher = std::function<DomainMesh<Dim>(const Cage<Dim>& cage, Index vertices)>;

//! Which coarser meshes to use.
struct CoarseLevels {
  //! Fewest vertices of a coarse mesh, >= 1; 0 = where it was measured to pay, which for small
  //! meshes means none at all.
  Index coarsest = 0;

  //! Vertices of a mesh relative to the next coarser one, >= 2; 0 = as it was measured to pay.
  double factor = 0;

  //! Tolerance on coarse meshes relative to the one wanted, > 0.
  double looseness = 4;
};

//! As solve(), with the same result up to the tolerance, for Method::kValue and kGradient started
//! from weights and duals of a coarser mesh, which is solved in the same way; other methods start
//! as ever. A coarse mesh is left out if the mesher throws (the cage may be too fine for so few
//! vertices) or does not make a clearly smaller mesh.
//!
//! The report is that of the given mesh and lists the coarser ones besides; their seconds, meshing
//! included, count as part of the solve. Options::progress is called on all of them.
//! \param problem  made with options.phi
//! \param mesher  not empty
//! \throws OptionError, SolverError; InputError if a coarse mesh does not belong to the cage
template <int Dim>
Solution solve_coarse_to_fine(const LbcProblem<Dim>& problem, const CoarseMesher<Dim>& mesher,
                              const SolverOptions& options = {}, const CoarseLevels& levels = {},
                              StateStorage* storage = nullptr);

//! One call from cage and mesh to coordinates. \throws InputError, OptionError, SolverError
template <int Dim>
Solution solve_coarse_to_fine(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                              const CoarseMesher<Dim>& mesher, const SolverOptions& options = {},
                              const CoarseLevels& levels = {});

}  // namespace flbc
