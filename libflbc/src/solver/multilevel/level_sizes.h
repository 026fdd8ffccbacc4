// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Which coarser meshes pay.
#pragma once

#include <vector>

#include "flbc/options.h"

namespace flbc {

//! Numbers of vertices of the coarse meshes for a mesh of `finest` vertices, ascending; none where
//! they do not pay. \param method  kValue, kGradient or kLbc2014 \param on_supports  whether the
//! iteration can work on supports, which a coarse mesh tells
template <int Dim>
std::vector<Index> level_sizes(Index finest, Index control_points, Method method, bool on_supports,
                               const CoarseLevels& levels);

}  // namespace flbc
