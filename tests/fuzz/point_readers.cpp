// SPDX-License-Identifier: BSD-3-Clause
// Files of points that are rewritten in batches.
#include <sstream>
#include <string>

#include "flbc/errors.h"
#include "flbc/io/point_file.h"
#include "fuzz/reader.h"

namespace flbc::fuzz {
namespace {

template <int Dim>
std::string copied(const std::string& path, const io::PointLayout& layout) {
  std::ostringstream out;
  io::rewrite_points<Dim>(path, layout, out, [](const PointList<Dim>& batch, std::int64_t) {
    require(batch.allFinite(), "points are finite");
    return batch;
  });
  return out.str();
}

void read_points(const std::string& path) {
  const auto layout = io::find_point_layout(path);
  if (!layout) throw InputError(path + ": not to be rewritten in batches");
  require(layout->offsets.size() == 2 || layout->offsets.size() == 3, "points are in 2D or 3D");
  for (const auto offset : layout->offsets) {
    require(offset + (layout->is_double ? 8 : 4) <= layout->stride, "records hold the coordinates");
  }
  const auto copy =
      layout->offsets.size() == 2 ? copied<2>(path, *layout) : copied<3>(path, *layout);
  require(copy == get_file(path), "points that do not move leave the file as it is");
}

// Two points that are small numbers.
std::string coordinates(int bytes) {
  std::string one(static_cast<std::size_t>(bytes), '\0');
  one.back() = '\x3f';
  return one + std::string(static_cast<std::size_t>(5 * bytes), '\0');
}

std::string npy_of_shape(const std::string& shape) {
  return npy("{'descr': '<f8', 'fortran_order': False, 'shape': " + shape + ", }", coordinates(8));
}

std::string ply(const std::string& type, int bytes) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty " + type +
         " x\nproperty " + type + " y\nproperty " + type +
         " z\nelement camera 1\nproperty uchar kind\n" + "end_header\n" + coordinates(bytes) + '\3';
}

}  // namespace

std::vector<Reader> point_readers() {
  return {
      {"points_npy", "input.npy", read_points, {npy_of_shape("(2, 3)"), npy_of_shape("(3, 2)")}},
      {"points_ply", "input.ply", read_points, {ply("float", 4), ply("double", 8)}}};
}

}  // namespace flbc::fuzz
