// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Optima to measure errors against, kept under OUT/references.
#pragma once

#include "flbc/options.h"
#include "paper/context.h"
#include "paper/setting.h"

namespace flbc::bench {

//! An optimum of problem (1) of the paper on a mesh, non-negativity included.
struct Reference {
  WeightMatrix weights;  //!< n x V
  double relative_gap;   //!< certified
};

//! How optima are computed, also those of table 1.
SolverOptions optimum_options(const Context& context, NonNegative non_negative);

//! Reads the reference from OUT/references if it was made for exactly this problem and is whole,
//! else computes and keeps it: weights as .npy, and a .json with what they belong to.
template <int Dim>
Reference reference(const Context& context, const Setting<Dim>& setting);

}  // namespace flbc::bench
