// SPDX-License-Identifier: BSD-3-Clause
// The NumPy array format: magic, version, length of the header, header (a Python dictionary in
// text, padded so that the numbers start at a multiple of 64 bytes), numbers.

#include <algorithm>
#include <limits>
#include <ostream>
#include <string_view>
#include <utility>

#include "flbc/errors.h"
#include "weights/npy_header.h"
#include "weights/weights_formats.h"

namespace flbc::io {

// Signature required by the format table. NOLINTNEXTLINE(performance-unnecessary-value-param)
SparseWeights read_npy(const std::string& path, std::string content) {
  const NpyHeader header = read_npy_header(path, content);
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

void write_npy(std::ostream& out, const SparseWeights& sparse) {
  const WeightMatrix weights = sparse.dense();
  // In memory the numbers of a point are contiguous, which is C order for #points x n.
  const std::string header = npy_header("<f8", {weights.cols(), weights.rows()});
  out.write(header.data(), static_cast<std::streamsize>(header.size()));
  out.write(reinterpret_cast<const char*>(weights.data()),
            static_cast<std::streamsize>(sizeof(double)) * weights.size());
}

}  // namespace flbc::io
