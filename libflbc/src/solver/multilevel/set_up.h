// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From cage and mesh to a problem, with what coarser meshes can do for it.
#pragma once

#include <optional>
#include <vector>

#include "solver/multilevel/coarse_problem.h"
#include "solver/run/reporter.h"

namespace flbc {

//! A problem, and those on coarser meshes that its solution starts from.
template <int Dim>
struct SetUp {
  LbcProblem<Dim> problem;
  std::vector<CoarseProblem<Dim>> coarse{};  //!< coarsest first
  DistanceReport distances{};
  double seconds = 0;  //!< without those that the coarse problems report
};

//! Sets a problem up as make_problem() does, but with distances from a coarser mesh where the
//! options say so, and without phi where the method does not need it.
//! \param options  resolved
//! \param mesher  may be empty unless options demand it; with several threads it is called from
//! one of its own
//! \param coarsest  where to leave the mesh whose distances were computed, with the places of the
//! finest one's vertices, if distances were interpolated; may be null
//! \param topology  of the mesh where it is known, else null
//! \throws InputError, SolverError
template <int Dim>
SetUp<Dim> set_up(Cage<Dim> cage, DomainMesh<Dim> mesh, const SolverOptions& options,
                  const CoarseMesher<Dim>& mesher, const Reporter& reporter,
                  std::optional<CoarseProblem<Dim>>* coarsest = nullptr,
                  const MeshTopology<Dim>* topology = nullptr);

}  // namespace flbc
