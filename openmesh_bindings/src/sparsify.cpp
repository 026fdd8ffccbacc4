// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/sparsify.h"

namespace flbc::openmesh::internal {

void require_rest_cage(const Eigen::MatrixXd& cage, const std::string& weights) {
  if (cage.size() > 0) return;
  throw InputError("the mesh does not know the cage of its weights '" + weights +
                   "'; call sparsify(mesh, cage, k), or set_rest_cage() first");
}

}  // namespace flbc::openmesh::internal
