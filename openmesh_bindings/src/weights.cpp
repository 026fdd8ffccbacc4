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

void require_vertices(std::size_t vertices, std::size_t rows) {
  if (vertices == rows) return;
  throw InputError("the mesh has " + std::to_string(vertices) + " vertices, but weights of " +
                   std::to_string(rows) +
                   "; clean() of OpenMesh does not shrink properties: bind the mesh again");
}

SparseWeights to_sparse(const RowBlock<double>& rows) {
  return SparseWeights::of(static_cast<Index>(rows.width()), static_cast<Index>(rows.size()),
                           [&](Index v) -> Eigen::VectorXd {
                             return rows[static_cast<std::size_t>(v)].matrix().row(0).transpose();
                           });
}

SparseWeights to_sparse(const InfluenceBlock& block) {
  const auto n = static_cast<Index>(block.num_control_points());
  return SparseWeights::of(n, static_cast<Index>(block.size()), [&](Index v) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
    const auto influences = block[static_cast<std::size_t>(v)];
    for (std::size_t j = 0; j < influences.size(); ++j) {
      if (influences.weight(j) != 0) row[influences.control_point(j)] += influences.weight(j);
    }
    return row;
  });
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
std::string name_of_masks(const std::string& weights) {
  return weights + ":masks";
}
std::string name_of_held(const std::string& weights) {
  return weights + ":held";
}

std::string name_of_mirror(const std::string& weights) {
  return weights + ":mirror";
}

}  // namespace flbc::openmesh::internal
