// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Other coordinates for comparison with local barycentric ones, by their names.
#pragma once

#include "flbc/pointwise.h"
#include "flbc/solver.h"

namespace flbc {

//! Options of compute_coordinates().
struct CoordinatesOptions {
  //! kProject makes weights non-negative (non_negative.h); kAuto and kOff leave them as they are.
  NonNegative non_negative = NonNegative::kAuto;

  //! As in SolverOptions.
  int threads = 0;
};

//! Checks options. compute_coordinates() calls it first.
//! \throws OptionError naming the field, or what the coordinates do not support
void validate(Coordinates coordinates, const CoordinatesOptions& options);

//! Coordinates at the vertices of a domain mesh. Parameters, parts of the cage, and errors are as
//! for solve(). The observer receives Stage::kNonNegative.
//! \return weights and report: sizes, seconds, and quality; the method stays kAuto
template <int Dim>
Solution compute_coordinates(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                             Coordinates coordinates, const CoordinatesOptions& options = {},
                             const Observer& observer = {});

}  // namespace flbc
