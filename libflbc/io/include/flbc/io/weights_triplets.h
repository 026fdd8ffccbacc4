// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights as text, one "CONTROL_POINT POINT WEIGHT" per line, for exchange with other programs.
#pragma once

#include <string>

#include "flbc/sparse_weights.h"

namespace flbc::io {

//! Reads triplets with indices from 0 in any order. Missing weights are 0; '#' starts a comment.
//! The file does not contain the matrix size.
//! \param num_controls, num_points  matrix size
//! \return weights of num_points points
//! \throws IoError if the file cannot be read; InputError naming file and line if a line is not a
//! triplet, a number is out of range or not finite, or a pair occurs twice; InputError naming the
//! file if it has no triplet, or none for the last control point or the last point (it then belongs
//! to another cage or model)
SparseWeights read_weight_triplets(const std::string& path, Index num_controls, Index num_points);

//! The same without a known size; the largest indices in the file determine it.
//! \throws IoError; InputError as above, or if the matrix would be large and almost empty
SparseWeights read_weight_triplets(const std::string& path);

//! Writes nonzero weights point by point, with enough digits to read the same numbers back (at most
//! 17). The last weight is written even if it is 0, because it determines the matrix size.
//! \param weights  of the points
//! \throws IoError; InputError if a weight is not finite or there are none
void write_weight_triplets(const std::string& path, const SparseWeights& weights);

}  // namespace flbc::io
