// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Problems on coarser meshes of the same cage.
#pragma once

#include <optional>
#include <vector>

#include "flbc/cell_locator.h"
#include "flbc/coarse_to_fine.h"
#include "flbc/lbc_problem.h"
#include "flbc/options.h"
#include "flbc/report.h"
#include "solver/methods/active_set/active_lists.h"

namespace flbc {

//! A problem on a coarser mesh, to start from or to interpolate distances from.
template <int Dim>
struct CoarseProblem {
  LbcProblem<Dim> problem;
  std::vector<Location<Dim>> finest_vertices{};  //!< places of the finest mesh's vertices, if known
  LevelReport report{};                          //!< sizes and seconds of mesh and set-up
  //! Up to which distances from each control point are known, see BoundedDistances; empty if
  //! everywhere.
  Eigen::VectorXf reach{};
  std::optional<active_set::ColdStart<Dim>> cold{};  //!< that they were bounded by
};

//! The purposes of coarse problems.
struct CoarseUse {
  bool start = true;       //!< they are solved
  bool distances = false;  //!< finer meshes interpolate theirs
};

//! Distances by those of a coarse problem, n x V.
//! \param places  of the V vertices in the coarse mesh
template <int Dim>
DistanceMatrix distances_from(const LbcProblem<Dim>& coarse, const LbcProblem<Dim>& problem,
                              const std::vector<Location<Dim>>& places);

//! Meshes the cage and sets the problems up. Left out are meshes on which the mesher fails (the
//! cage may be too fine for so few vertices) or that are not clearly coarser than the next. The
//! coarsest one alone computes distances if finer meshes are to interpolate theirs; and where it is
//! solved on an active set, only as far as that needs them.
//! \param problem  the finest one, whose phi is not asked for
//! \param mesher  not empty
//! \param sizes  numbers of vertices, ascending
//! \param options  resolved
//! \return coarsest first
//! \throws InputError if a coarse mesh does not belong to the cage
template <int Dim>
std::vector<CoarseProblem<Dim>> make_coarse_problems(const LbcProblem<Dim>& problem,
                                                     const CoarseMesher<Dim>& mesher,
                                                     const std::vector<Index>& sizes,
                                                     const SolverOptions& options, CoarseUse use);

}  // namespace flbc
