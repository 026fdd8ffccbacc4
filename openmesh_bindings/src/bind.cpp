// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/bind.h"

#include <algorithm>
#include <iterator>

#include "base/messages.h"
#include "flbc/non_negative.h"
#include "flbc/sparsify.h"

namespace flbc::openmesh::internal {
namespace {

template <int Dim>
Eigen::VectorXd reproducing_in(const PointList<Dim>& cage, const PointList<Dim>& point,
                               const WeightMatrix& given, std::size_t most,
                               const std::vector<Mask>& masks) {
  auto weights = project_non_negative<Dim>(cage, point, given, {},
                                           PointMasks(masks, static_cast<Index>(cage.cols()), 1));
  if (most > 0) {
    SparsifyOptions options{static_cast<Index>(most)};
    options.masks = masks;
    weights = flbc::sparsify<Dim>(cage, point, weights, options);
  }
  return weights.at(0);
}

}  // namespace

Eigen::VectorXd reproducing(const Eigen::MatrixXd& cage, const Eigen::VectorXd& point, int vertex,
                            const Eigen::VectorXd& weights, std::size_t most,
                            const std::vector<Index>& masked) {
  std::vector<Mask> masks;
  if (!masked.empty()) masks.push_back({masked, {0}});
  try {
    return cage.rows() == 2 ? reproducing_in<2>(cage, point, weights, most, masks)
                            : reproducing_in<3>(cage, point, weights, most, masks);
  } catch (const InputError&) {
    throw InputError("vertex " + std::to_string(vertex) + " at " + format_point(point) +
                     " is outside the convex hull of the " +
                     (masks.empty() ? "cage" : "control points that may move it") +
                     "; move it inside");
  }
}

const std::vector<Index>& NewMasks::at(Index vertex) const {
  static const std::vector<Index> kNone;
  const auto found = new_.find(vertex);
  if (found != new_.end()) return found->second;
  return given_.empty() ? kNone : given_.forbidden(vertex);
}

std::vector<Index> NewMasks::add(Index vertex, const std::vector<Index>& neighbors) {
  auto masked = at(neighbors.front());
  for (const Index neighbor : neighbors) {
    std::vector<Index> common;
    const auto& other = at(neighbor);
    std::set_intersection(masked.begin(), masked.end(), other.begin(), other.end(),
                          std::back_inserter(common));
    masked = std::move(common);
  }
  if (!masked.empty()) {
    masks_.push_back({masked, {vertex}});
    new_.emplace(vertex, masked);
  }
  return masked;
}

void refuse_without_neighbors(int vertex) {
  throw InputError("vertex " + std::to_string(vertex) +
                   " is not connected with vertices that have weights; connect it, or bind the "
                   "model again");
}

void refuse_moved(int vertex) {
  throw InputError("vertex " + std::to_string(vertex) +
                   " is not where bind() found it, so the model is not at rest; call "
                   "restore_rest(), or bind the model again if its rest shape has changed");
}

template <int Dim>
void refuse_doubled_vertices(const Cage<Dim>& cage) {
  for (const auto& defect : find_defects(cage, 1)) {
    if (defect.kind != DefectKind::kCoincident) continue;
    throw InputError(defect.message +
                     "; OpenMesh doubles vertices where more than two faces meet at an edge when "
                     "it reads a file, so look for such edges in the file of the cage");
  }
}

template void refuse_doubled_vertices(const Cage<2>&);
template void refuse_doubled_vertices(const Cage<3>&);

}  // namespace flbc::openmesh::internal
