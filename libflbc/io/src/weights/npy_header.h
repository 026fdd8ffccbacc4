// SPDX-License-Identifier: BSD-3-Clause
// NumPy array files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
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

//! Converts the numbers that follow a header: float32, float64, int32, or int64.
//! \param owner  for messages \tparam Scalar  double, std::int32_t, or std::int64_t
//! \throws InputError for other types, if there are too few or too many bytes, or if a number is not
//! finite or does not fit
template <class Scalar>
std::vector<Scalar> npy_numbers(const std::string& owner, const NpyHeader& header,
                                std::string_view bytes);

//! The header of an array in C order: version 1, padded to 64 bytes. Inline for programs, to which
//! shared libraries do not export it.
//! \param type  NumPy's name
inline std::string npy_header(const std::string& type, const std::vector<std::int64_t>& shape) {
  std::string text = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (";
  for (std::size_t k = 0; k < shape.size(); ++k)
    text += (k > 0 ? ", " : "") + std::to_string(shape[k]);
  text += shape.size() == 1 ? ",), }" : "), }";
  constexpr std::size_t kAlignment = 64;
  constexpr std::size_t kPrefix = 10;  // magic, version, length
  const std::size_t unpadded = kPrefix + text.size() + 1;
  text.append((kAlignment - unpadded % kAlignment) % kAlignment, ' ');
  text += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  header += static_cast<char>(text.size() & 0xff);
  header += static_cast<char>(text.size() >> 8);
  return header + text;
}

}  // namespace flbc::io
