// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights of other programs: text with "CONTROL_POINT POINT WEIGHT" on every line.
#pragma once

#include <string>

#include "flbc/types.h"

namespace flbc::io {

//! Reads triplets, numbered from 0, in any order; what is missing is 0, and '#' starts a comment.
//! The file does not say how large the matrix is. \param num_controls, num_points  its size
//! \return num_controls x num_points
//! \throws IoError if the file cannot be read; InputError naming file and line for a line that is
//! no triplet, a number out of range or not finite, or a pair that occurs twice, and naming the
//! file if it has no triplet or none for the last control point or point (it belongs to others)
WeightMatrix read_weight_triplets(const std::string& path, Index num_controls, Index num_points);

}  // namespace flbc::io
