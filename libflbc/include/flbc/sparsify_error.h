// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! How far sparse weights are from those given, in weights and in deformations.
#pragma once

#include <vector>

#include "flbc/types.h"

namespace flbc {

//! Weights other than 0 per point.
struct Influences {
  double mean = 0;
  Index max = 0;
};
Influences count_influences(const WeightMatrix& weights);

//! Root of the mean square, and largest.
struct ErrorNorms {
  double rms = 0;
  double max = 0;
};

//! Of the differences of all single weights, both n x P. \throws InputError if sizes differ
ErrorNorms weight_error(const WeightMatrix& before, const WeightMatrix& after);

//! Of the distances between points deformed with either weights, over all points and poses, in
//! units of the poses. \param poses  Dim x n each, the displaced control points
//! \throws InputError if sizes do not fit
template <int Dim>
ErrorNorms deformation_error(const std::vector<PointList<Dim>>& poses, const WeightMatrix& before,
                             const WeightMatrix& after);

}  // namespace flbc
