// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights as a page holds them: a few influences per point.
#pragma once

#include "flbc/types.h"

namespace flbc::view {

//! Most influences of a point that a page holds.
constexpr Index kMostInfluences = 16;

//! Reduces the points that have more than `most` influences by sparsify(); all others keep their
//! weights as they are, negative ones too.
//! \param control_points  Dim x n \param points  Dim x P \param weights  n x P
//! \param most  Dim + 1 .. kMostInfluences
//! \return n x P
//! \throws OptionError if `most` is out of range; InputError as sparsify()
template <int Dim>
WeightMatrix limit_influences(const PointList<Dim>& control_points, const PointList<Dim>& points,
                              const WeightMatrix& weights, Index most);

}  // namespace flbc::view
