// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Problems on coarser meshes of the same cage.
#pragma once

#include <vector>

#include "flbc/cell_locator.h"
#include "flbc/coarse_to_fine.h"
#include "flbc/lbc_problem.h"
#include "flbc/report.h"
#include "solver/plan/settings.h"

namespace flbc {

//! A problem on a coarser mesh, for a multilevel start or for interpolated distances.
template <int Dim>
struct CoarseProblem {
  LbcProblem<Dim> problem;
  std::vector<Location<Dim>> finest_vertices{};  //!< locations of the vertices of the finest mesh,
                                                 //!< if known
  LevelReport report{};                          //!< sizes, and times of meshing and setup
};

//! The purposes of coarse problems.
struct CoarseUse {
  bool start = true;       //!< for a multilevel start
  bool distances = false;  //!< for interpolated distances
};

//! Distances interpolated from a coarse problem, n x V.
//! \param places  of the V vertices in the coarse mesh
template <int Dim>
DistanceMatrix distances_from(const LbcProblem<Dim>& coarse, const LbcProblem<Dim>& problem,
                              const std::vector<Location<Dim>>& places);

//! Meshes the cage and sets up the coarse problems. Skips meshes on which the mesher fails (the
//! cage may need more vertices), or that are not clearly coarser than the next. If finer meshes
//! interpolate distances, only the coarsest mesh computes them.
//! \param problem  the finest problem; phi is not needed
//! \param mesher  not empty
//! \param sizes  numbers of vertices, ascending
//!
//! \return coarsest first
//! \throws InputError if a coarse mesh does not belong to the cage
template <int Dim>
std::vector<CoarseProblem<Dim>> make_coarse_problems(const LbcProblem<Dim>& problem,
                                                     const CoarseMesher<Dim>& mesher,
                                                     const std::vector<Index>& sizes,
                                                     const plan::Settings& settings, CoarseUse use);

}  // namespace flbc
