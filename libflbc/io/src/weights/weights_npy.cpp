// SPDX-License-Identifier: BSD-3-Clause
// The NumPy array format: magic, version, length of the header, header (a Python dictionary in
// text, padded so that the numbers start at a multiple of 64 bytes), numbers.

#include <algorithm>
#include <limits>
#include <ostream>
#include <string_view>
#include <utility>
#include <vector>

#include "flbc/errors.h"
#include "weights/npy_header.h"
#include "weights/weights_formats.h"

namespace flbc::io {

// Signature required by the format table. NOLINTNEXTLINE(performance-unnecessary-value-param)
SparseWeights read_npy(const std::string& path, std::string content) {
  NpyHeader header = read_npy_header(path, content);
  if (header.shape.size() == 1) header.shape.push_back(1);
  if (header.shape.size() != 2) {
    throw InputError(path + ": the array has " + std::to_string(header.shape.size()) +
                     " dimensions; weights need 2, points x control points");
  }
  const auto [num_points, num_controls] = std::pair(header.shape[0], header.shape[1]);
  constexpr std::int64_t kMaxIndex = std::numeric_limits<Index>::max();
  constexpr std::int64_t kHarmless = std::int64_t{1} << 20;  // empty arrays have no more
  const auto most = std::max(num_points, num_controls);
  if (most > kMaxIndex || (num_points * num_controls == 0 && most > kHarmless)) {
    throw InputError(path + ": " + std::to_string(num_points) + " x " +
                     std::to_string(num_controls) + " numbers are not a weight matrix");
  }
  const auto numbers = npy_numbers<double>(path + ": the array", header,
                                           std::string_view(content).substr(header.size));
  using ByControlPoint = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  if (header.fortran_order) {
    return WeightMatrix(Eigen::Map<const ByControlPoint>(numbers.data(), num_controls, num_points));
  }
  return WeightMatrix(Eigen::Map<const WeightMatrix>(numbers.data(), num_controls, num_points));
}

void write_npy(std::ostream& out, const SparseWeights& weights) {
  const auto n = static_cast<std::size_t>(weights.num_control_points());
  out << npy_header("<f8", {weights.num_points(), weights.num_control_points()});
  constexpr std::size_t kAtOnce = 1 << 16;  // numbers
  std::vector<double> rows;
  for (Index p = 0; p < weights.num_points(); ++p) {
    const std::size_t start = rows.size();
    rows.resize(start + n);
    weights.visit(p, [&](Index i, double weight) { rows[start + i] = weight; });
    if (rows.size() < kAtOnce && p + 1 < weights.num_points()) continue;
    out.write(reinterpret_cast<const char*>(rows.data()),
              static_cast<std::streamsize>(sizeof(double) * rows.size()));
    rows.clear();
  }
}

}  // namespace flbc::io
