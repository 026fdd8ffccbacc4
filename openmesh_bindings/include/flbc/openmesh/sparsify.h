// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Reduces influences per vertex on a mesh.
#pragma once

#include <algorithm>
#include <string>
#include <type_traits>

#include "flbc/deform.h"
#include "flbc/openmesh/convert.h"
#include "flbc/openmesh/weights.h"
#include "flbc/quality.h"
#include "flbc/sparsify.h"

namespace flbc::openmesh {

using flbc::Reduction;

//! Options of sparsify().
struct ReductionOptions {
  Reduction reduction = Reduction::kPoisson;  //!< meshes without edges are reduced quadratically
  double threshold = 0;                       //!< as SparsifyOptions::threshold, in [0, 1)
  std::string weights = kWeights;             //!< the property to reduce
  std::string into{};       //!< name of the new property; empty: replace `weights`
  bool persistent = false;  //!< whether .om files store it
};

namespace internal {

void require_rest_cage(const Eigen::MatrixXd& cage, const std::string& weights);

}  // namespace internal

//! Reduces the weights to at most `most` influences per vertex, as a property of type Influences.
//! Weights are non-negative, sum to 1, and keep the rest positions. \param cage  rest cage of the
//! weights
//! \return quality of the new weights
//! \throws OptionError for fewer than Dim + 1 influences; InputError if the mesh has no weights of
//! this name, or weights for another cage
template <class Mesh, int Dim>
Quality sparsify(Mesh& mesh, const PointList<Dim>& cage, Index most,
                 const ReductionOptions& options = {}) {
  const auto weights = get_weights(mesh, options.weights);
  internal::require_control_points(static_cast<std::size_t>(weights.rows()), cage.cols());
  const PointList<Dim> rest = cage * weights;
  // Edge lengths are those of the rest mesh.
  const auto edges = internal::edge_list_at<Dim>(mesh, rest);
  const auto reduced = reduce_influences<Dim>(cage, rest, edges, SparseWeights(weights), {},
                                              {most, options.threshold}, options.reduction);
  const std::string& into = options.into.empty() ? options.weights : options.into;
  const auto offset = internal::offsets_of(mesh, options.weights);
  set_influences(mesh, reduced, static_cast<std::size_t>(std::min<Eigen::Index>(most, cage.cols())),
                 into, options.persistent);
  internal::set_offsets(mesh, offset, into, options.persistent);
  set_rest_cage(mesh, cage, into, options.persistent);
  return measure_quality<Dim>(cage, rest, reduced);
}

//! The same with the rest cage stored by solve() or bind().
//! \throws InputError also if there is no rest cage
template <class Mesh>
Quality sparsify(Mesh& mesh, Index most, const ReductionOptions& options = {}) {
  const auto cage = get_rest_cage(mesh, options.weights);
  internal::require_rest_cage(cage, options.weights);
  if constexpr (!std::is_same_v<Mesh, TetMesh>) {
    if (cage.rows() == 2) return sparsify(mesh, PointList<2>(cage), most, options);
  }
  if constexpr (kPointSize<Mesh> == 3) {
    if (cage.rows() == 3) return sparsify(mesh, PointList<3>(cage), most, options);
  }
  throw InputError("the cage of the weights '" + options.weights + "' has " +
                   std::to_string(cage.rows()) + " dimensions, but the mesh does not");
}

}  // namespace flbc::openmesh
