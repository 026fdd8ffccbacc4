// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Distances from a coarser mesh where they are good enough.
#pragma once

#include "flbc/options.h"
#include "flbc/report.h"
#include "solver/multilevel/coarse_problem.h"

namespace flbc {

//! Interpolates distances, checks them against exact ones of some control points, and for
//! Distances::kAuto computes all of them if they change the weights too much.
//! \param coarse  with the places of the problem's vertices
//! \param problem  whose phi is not asked for
//! \param report  becomes what was done
//! \return n x V
template <int Dim>
DistanceMatrix choose_distances(const CoarseProblem<Dim>& coarse, const LbcProblem<Dim>& problem,
                                const SolverOptions& options, DistanceReport& report);

}  // namespace flbc
