// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The problem on the coarse mesh of a refined mesh: source of distances and of a start.
#pragma once

#include <optional>

#include "flbc/nested_mesh.h"
#include "flbc/report.h"
#include "problem/problem_geometry.h"
#include "solver/plan/settings.h"
#include "solver/run/reporter.h"

namespace flbc {

//! A problem on a coarse mesh.
template <int Dim>
struct CoarseProblem {
  LbcProblem<Dim> problem;
  std::vector<std::array<Index, 2>> ends{};  //!< CoarseMesh::ends
};

//! A problem with its coarse problem.
template <int Dim>
struct NestedProblem {
  LbcProblem<Dim> problem;
  std::optional<CoarseProblem<Dim>> coarse{};  //!< if the mesh is refined and the method starts so
  DistanceReport distances{};
};

//! The coarse problem for a method that can start from it. \param problem  phi is not needed
//! \return nothing if the mesh is not refined
template <int Dim>
std::optional<CoarseProblem<Dim>> coarse_problem(const LbcProblem<Dim>& problem,
                                                 const plan::Settings& settings);

//! Completes the geometry of a problem by phi, as make_problem() does. Distances come from the
//! coarse mesh if the options say so. \param stage  of the distances
template <int Dim>
NestedProblem<Dim> set_up(LbcProblem<Dim> geometry, const plan::Settings& settings,
                          const Reporter& reporter);

}  // namespace flbc
