// SPDX-License-Identifier: BSD-3-Clause
// The weight file formats, one source file each. Contracts as in flbc/io/weights_io.h.
#pragma once

#include <iosfwd>
#include <string>

#include "flbc/sparse_weights.h"

namespace flbc::io {

// The binary formats store doubles in native byte order.
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "binary weight files need a little-endian machine"
#endif

//! Parse a file's content; `path` is for messages.
SparseWeights read_mtx(const std::string& path, std::string content);
SparseWeights read_npy(const std::string& path, std::string content);
SparseWeights read_csv(const std::string& path, std::string content);
SparseWeights read_npz(const std::string& path, std::string content);

//! Checks that weights are finite, because readers reject other values. \throws InputError naming
//! the first one
void check_finite(const SparseWeights& weights);

void write_mtx(std::ostream& out, const SparseWeights& weights);
void write_npy(std::ostream& out, const SparseWeights& weights);
void write_csv(std::ostream& out, const SparseWeights& weights);
void write_npz(std::ostream& out, const SparseWeights& weights);

}  // namespace flbc::io
