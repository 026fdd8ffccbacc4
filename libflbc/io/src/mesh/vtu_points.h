// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Where a VTK XML file has its points as raw bytes after the XML.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace flbc::io {

struct VtuPoints {
  std::size_t block = 0;       //!< position of the block: its size in bytes, then the coordinates
  std::size_t size_width = 0;  //!< bytes of this size: 4 or 8, little-endian
  std::int64_t count = 0;      //!< points, of 3 coordinates
  bool is_double = false;      //!< float64, otherwise float32
};

//! \param start  of the file
//! \return nothing if no appended data begin here, or the points are not part of them
//! \throws InputError if the XML is malformed, or appended points are not raw, not little-endian,
//! compressed, in several pieces, or not 3 floating-point numbers each
std::optional<VtuPoints> find_vtu_points(const std::string& path, const std::string& start);

}  // namespace flbc::io
