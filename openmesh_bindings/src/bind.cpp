// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/bind.h"

#include "base/messages.h"
#include "flbc/non_negative.h"
#include "flbc/sparsify.h"

namespace flbc::openmesh::internal {
namespace {

template <int Dim>
Eigen::VectorXd reproducing_in(const PointList<Dim>& cage, const PointList<Dim>& point,
                               const WeightMatrix& given, std::size_t most) {
  auto weights = project_non_negative(cage, point, given);
  if (most > 0) weights = flbc::sparsify<Dim>(cage, point, weights, {static_cast<Index>(most)});
  return weights.at(0);
}

}  // namespace

Eigen::VectorXd reproducing(const Eigen::MatrixXd& cage, const Eigen::VectorXd& point, int vertex,
                            const Eigen::VectorXd& weights, std::size_t most) {
  try {
    return cage.rows() == 2 ? reproducing_in<2>(cage, point, weights, most)
                            : reproducing_in<3>(cage, point, weights, most);
  } catch (const InputError&) {
    throw InputError("vertex " + std::to_string(vertex) + " at " + format_point(point) +
                     " is outside the convex hull of the cage; move it inside");
  }
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
