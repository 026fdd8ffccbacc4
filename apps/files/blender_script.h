// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights as vertex groups of Blender.
#pragma once

#include <string>

#include "flbc/sparse_weights.h"
#include "flbc/types.h"

namespace flbc::app {

//! A program for Blender: run there with the imported model as active object, it gives the model a
//! vertex group per control point, and an armature whose bones, as the groups, are named
//! "control_point_0" and so on. Moving a bone moves the model as flbc deform does.
//! \param control_points  Dim x n, in the model's coordinates
//! \param weights  n x P
template <int Dim>
std::string blender_script(const PointList<Dim>& control_points, const SparseWeights& weights);

}  // namespace flbc::app
