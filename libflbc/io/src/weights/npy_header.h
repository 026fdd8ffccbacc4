// SPDX-License-Identifier: BSD-3-Clause
// The header of NumPy array files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace flbc::io {

struct NpyHeader {
  std::string type;  //!< NumPy's name, for example "<f8"
  bool fortran_order = false;
  std::vector<std::int64_t> shape;
  std::size_t size = 0;  //!< bytes before the numbers
};

//! Parses the header of a file of version 1 to 3.
//! \throws InputError naming file and byte
NpyHeader read_npy_header(const std::string& path, const std::string& content);

//! The header of a rows x columns array of float64 in C order: version 1, padded to 64 bytes.
std::string npy_header(std::int64_t rows, std::int64_t columns);

}  // namespace flbc::io
