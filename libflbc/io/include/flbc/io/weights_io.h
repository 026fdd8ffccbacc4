// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weight files. In every format a row belongs to a point and a column to a control point, as users
//! of other tools expect; in memory it is the transpose (see types.h). What is written is read back
//! bit by bit.
#pragma once

#include <string>

#include "flbc/sparse_weights.h"

namespace flbc::io {

//! Reads Matrix Market (.mtx: coordinate or array, real or integer, general), DMAT (.dmat, text or
//! binary, as libigl writes it) or NumPy (.npy: version 1 to 3, float32 or float64, C or Fortran
//! order, two dimensions).
//! \return n x #points
//! \throws IoError if the file cannot be read, InputError naming the file and the line or byte
//! where it is malformed, has a number that is not finite, or ends early; OptionError for another
//! extension
WeightMatrix read_weights(const std::string& path);

//! The same without zeros; no matrix is made of .mtx.
SparseWeights read_sparse_weights(const std::string& path);

//! Writes the format chosen by the extension: .mtx (coordinate real general, 17 digits, zeros left
//! out), .dmat (binary) or .npy (float64). \param weights n x #points
//! \throws IoError if the file cannot be written, InputError if a weight is not finite, OptionError
//! for another extension
void write_weights(const std::string& path, const WeightMatrix& weights);

//! The same file from weights without their zeros; no matrix is made for .mtx.
void write_weights(const std::string& path, const SparseWeights& weights);

}  // namespace flbc::io
