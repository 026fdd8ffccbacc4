// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/sparsify.h"

namespace flbc::openmesh::internal {

template <int Dim>
SparseWeights reduce(const PointList<Dim>& control_points, const PointList<Dim>& points,
                     const EdgeList& edges, const SparseWeights& weights, Reduction reduction,
                     const SparsifyOptions& options) {
  if (reduction == Reduction::kQuadratic) {
    return flbc::sparsify<Dim>(control_points, points, weights, options);
  }
  return reduce_influences<Dim>(control_points, points, edges, weights, {}, options);
}

void require_rest_cage(const Eigen::MatrixXd& cage, const std::string& weights) {
  if (cage.size() > 0) return;
  throw InputError("the mesh does not know the cage of its weights '" + weights +
                   "'; call sparsify(mesh, cage, k), or set_rest_cage() first");
}

template SparseWeights reduce(const PointList<2>&, const PointList<2>&, const EdgeList&,
                              const SparseWeights&, Reduction, const SparsifyOptions&);
template SparseWeights reduce(const PointList<3>&, const PointList<3>&, const EdgeList&,
                              const SparseWeights&, Reduction, const SparsifyOptions&);

}  // namespace flbc::openmesh::internal
