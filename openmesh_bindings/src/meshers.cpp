// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/meshers.h"

#include <utility>

namespace flbc::openmesh::internal {

template <int Dim>
CoarseMesher<Dim> coarse_mesher(Mesher<Dim> mesher) {
  if (!mesher) return {};
  // A mesher that fails on few vertices must not delay the solve.
  constexpr double kTimeLimit = 60;
  return [mesher = std::move(mesher)](const Cage<Dim>& cage, Index vertices) {
    MeshingOptions<Dim> meshing;
    meshing.vertices = vertices;
    meshing.roughly = true;
    meshing.time_limit = kTimeLimit;
    return mesher(cage, meshing);
  };
}

template CoarseMesher<2> coarse_mesher(Mesher<2>);
template CoarseMesher<3> coarse_mesher(Mesher<3>);

}  // namespace flbc::openmesh::internal
