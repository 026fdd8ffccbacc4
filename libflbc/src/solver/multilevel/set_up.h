// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Sets up a problem from cage and mesh, with the help of coarser meshes.
#pragma once

#include <optional>
#include <vector>

#include "solver/multilevel/coarse_problem.h"
#include "solver/run/reporter.h"

namespace flbc {

//! A problem, and coarse problems for its multilevel start.
template <int Dim>
struct SetUp {
  LbcProblem<Dim> problem;
  std::vector<CoarseProblem<Dim>> coarse{};  //!< coarsest first
  DistanceReport distances{};
  double seconds = 0;  //!< without time reported by the coarse problems
};

//! Sets up a problem as make_problem() does. Distances come from a coarser mesh if the options say
//! so.
//!
//! \param mesher  may be empty unless required by options; called from a separate thread if there
//! are several
//! \param coarsest  output: the mesh with computed distances and the locations of the finest
//! vertices, if distances were interpolated; may be null
//! \param topology  of the mesh, or null if unknown
//! \throws InputError, SolverError
template <int Dim>
SetUp<Dim> set_up(Cage<Dim> cage, DomainMesh<Dim> mesh, const plan::Settings& settings,
                  const CoarseMesher<Dim>& mesher, const Reporter& reporter,
                  std::optional<CoarseProblem<Dim>>* coarsest = nullptr,
                  const MeshTopology<Dim>* topology = nullptr);

}  // namespace flbc
