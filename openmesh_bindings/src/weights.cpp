// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/weights.h"

#include <algorithm>

namespace flbc::openmesh::internal {

void require_number_of_vertices(Eigen::Index in_weights, std::size_t in_mesh) {
  if (in_weights == static_cast<Eigen::Index>(in_mesh)) return;
  throw InputError("weights for " + std::to_string(in_weights) +
                   " points do not match a mesh with " + std::to_string(in_mesh) + " vertices");
}

void require_control_points(std::size_t in_weights, Eigen::Index in_cage) {
  if (in_weights == static_cast<std::size_t>(in_cage)) return;
  throw InputError("weights for " + std::to_string(in_weights) +
                   " control points do not match a cage with " + std::to_string(in_cage));
}

void refuse_without_weights(const std::string& name) {
  throw InputError("the mesh has no weights: there is no vertex property '" + name + "'");
}

WeightMatrix to_matrix(const RowBlock<double>& rows) {
  return Eigen::Map<const Eigen::MatrixXd>(rows.data(), static_cast<Eigen::Index>(rows.width()),
                                           static_cast<Eigen::Index>(rows.size()));
}

WeightMatrix to_matrix(const InfluenceBlock& block) {
  WeightMatrix weights = WeightMatrix::Zero(static_cast<Eigen::Index>(block.num_control_points()),
                                            static_cast<Eigen::Index>(block.size()));
  for (std::size_t v = 0; v < block.size(); ++v) {
    const auto influences = block[v];
    for (std::size_t j = 0; j < influences.size(); ++j) {
      if (influences.weight(j) == 0) continue;
      weights(influences.control_point(j), static_cast<Eigen::Index>(v)) += influences.weight(j);
    }
  }
  return weights;
}

InfluenceBlock to_influences(const SparseWeights& weights, std::size_t most) {
  const auto& starts = weights.starts();
  const auto count = static_cast<std::size_t>(weights.num_points());
  const auto size_of = [&](std::size_t p) {
    return static_cast<std::size_t>(starts[p + 1] - starts[p]);
  };
  const bool is_limited = most > 0;
  for (std::size_t p = 0; p < count; ++p) {
    if (is_limited && size_of(p) > most) {
      throw InputError("vertex " + std::to_string(p) + " has " + std::to_string(size_of(p)) +
                       " weights, more than " + std::to_string(most) + "; call sparsify() first");
    }
    if (!is_limited) most = std::max(most, size_of(p));
  }
  InfluenceBlock block(static_cast<std::size_t>(weights.num_control_points()), most);
  block.resize(count);
  for (std::size_t p = 0; p < count; ++p) {
    const auto influences = block[p];
    const auto start = static_cast<std::size_t>(starts[p]);
    std::copy_n(weights.control_points().data() + start, size_of(p), influences.control_points());
    std::copy_n(weights.values().data() + start, size_of(p), influences.weights());
  }
  return block;
}

std::string name_of_cage(const std::string& weights) {
  return weights + ":cage";
}
std::string name_of_offset(const std::string& weights) {
  return weights + ":offset";
}
std::string name_of_rest(const std::string& weights) {
  return weights + ":rest";
}

}  // namespace flbc::openmesh::internal
