// SPDX-License-Identifier: BSD-3-Clause
// The weight file formats, one source file each. Contracts as in flbc/io/weights_io.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>

#include "flbc/sparse_weights.h"

namespace flbc::io {

class TextReader;

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

//! Maximum number of matrix elements (8 MiB) that a file may declare without storing. In a larger
//! matrix, each row and column must have an element, because weights sum to 1.
constexpr std::int64_t kHarmlessElements = std::int64_t{1} << 20;

//! Whether a header declares no weights but an implausible number of points or control points. This
//! means a damaged file, which the file length cannot reveal.
bool is_absurd(std::int64_t num_points, std::int64_t num_controls);

//! Reads #points x n numbers, control point by control point, up to the end of the file.
WeightMatrix read_columns(TextReader& reader, Index num_points, Index num_controls);

//! A block of numbers that reaches from byte `offset` to the end of a binary file.
struct BinaryBlock {
  const std::string& path;
  const std::string& content;
  std::size_t offset;

  //! Throws unless exactly num_points x num_controls numbers of `bytes_each` bytes follow.
  void check_size(std::int64_t num_points, std::int64_t num_controls, std::size_t bytes_each) const;

  //! Copies the numbers into a matrix. \param by_point whether the numbers of a point are
  //! contiguous, instead of those of a control point \throws InputError if a number is not finite
  template <class Scalar>
  WeightMatrix read(std::int64_t num_points, std::int64_t num_controls, bool by_point) const;

  //! Throws the InputError that names file and byte.
  [[noreturn]] void fail(std::size_t byte, const std::string& message) const;
};

}  // namespace flbc::io
