// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weight files. In every format a row belongs to a point and a column to a control point, as in
//! other tools; matrices in memory are the transpose (see types.h). Reading returns exactly the
//! values that were written.
#pragma once

#include <string>

#include "flbc/sparse_weights.h"

namespace flbc::io {

//! Reads Matrix Market (.mtx: coordinate, real or integer, general), NumPy (.npy: version
//! 1 to 3, float32 or float64, C or Fortran order, two dimensions, or one for a column), or .csv.
//! \return weights of the points; for .mtx, no dense matrix is allocated
//! \throws IoError if the file cannot be read; InputError naming file and line or byte if it is
//! malformed, contains a non-finite number, or ends early; OptionError for another extension
SparseWeights read_weights(const std::string& path);

//! Writes the format chosen by the extension: .mtx (coordinate real general, 17 digits, without
//! zeros), .npy (float64), or .csv. For .mtx, no dense matrix is allocated.
//! \param weights  of the points
//! \throws IoError if the file cannot be written; InputError if a weight is not finite; OptionError
//! for another extension
void write_weights(const std::string& path, const SparseWeights& weights);

}  // namespace flbc::io
