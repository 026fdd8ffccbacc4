// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Files of points of any size, rewritten in batches of bounded memory.
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "flbc/types.h"

namespace flbc::io {

//! Where a file stores the coordinates of points: in records of the same size.
struct PointLayout {
  std::size_t header = 0;              //!< bytes before the first record
  std::size_t stride = 0;              //!< bytes of a record
  std::int64_t count = 0;              //!< records
  std::vector<std::size_t> offsets{};  //!< of each coordinate in a record, in bytes
  bool is_double = false;              //!< float64, otherwise float32
};

//! Reads only the header.
//! \return nothing unless the file is a .npy array in C order, or a binary little-endian .ply file
//! that starts with vertices without normals and has no faces
//! \throws IoError; InputError if the header is malformed, a .npy array is not points, or the file is
//! shorter than its header says
std::optional<PointLayout> find_point_layout(const std::string& path);

//! Copies a file with other coordinates. All other bytes stay the same.
//! \param layout  of the file; has at least Dim coordinates
//! \param move  returns the new coordinates of a batch, Dim x B; `first` is the number of its first
//! point
//! \throws IoError; InputError naming the first point that is not finite
template <int Dim>
void rewrite_points(
    const std::string& path, const PointLayout& layout, std::ostream& out,
    const std::function<PointList<Dim>(const PointList<Dim>& batch, std::int64_t first)>& move);

}  // namespace flbc::io
