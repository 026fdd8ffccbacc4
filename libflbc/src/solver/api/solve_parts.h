// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Solves cages whose interior has several connected parts.
#pragma once

#include <functional>
#include <vector>

#include "flbc/solver.h"

namespace flbc {

//! Solves one connected part. \param control_points  their indices in the whole cage
//! \param stopped  whether the caller stopped the solve of a part before, so that one iteration
//! suffices
template <int Dim>
using SolvePart = std::function<Solution(const Cage<Dim>&, const DomainMesh<Dim>&, const Observer&,
                                         const std::vector<Index>& control_points, bool stopped)>;

//! Checks the mesh, and solves every part of it with the control points that are its vertices. If
//! there is one part, it is the mesh itself.
//! \throws InputError as validate(), or if the parts of mesh and cage differ
template <int Dim>
Solution solve_parts(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, const Observer& observer,
                     const SolvePart<Dim>& solve_part);

}  // namespace flbc
