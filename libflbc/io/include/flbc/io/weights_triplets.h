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

//! The same where nothing tells the size: it is as large as the largest numbers in the file ask.
//! \throws IoError; InputError as above, or if it would be large and almost empty
WeightMatrix read_weight_triplets(const std::string& path);

//! Writes weights that are not 0 point by point, with the digits it takes to read the same numbers
//! back (at most 17), and the last weight of all even if it is 0, because it tells the size.
//! \param weights  n x #points
//! \throws IoError; InputError if a weight is not finite or there are none
void write_weight_triplets(const std::string& path, const WeightMatrix& weights);

}  // namespace flbc::io
