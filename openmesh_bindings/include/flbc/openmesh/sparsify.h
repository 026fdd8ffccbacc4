// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Reduces influences per vertex on a mesh.
#pragma once

#include <string>
#include <type_traits>

#include "flbc/openmesh/binding.h"
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
  std::string into{};  //!< name of the new property; empty: replace `weights`
};

//! Reduces the weights to at most `most` influences per vertex, as a property of type Influences.
//! Weights are non-negative, sum to 1, and keep the rest positions. All else of a binding stays:
//! masked weights are exactly 0, mirrored ones bit-identical, and vertices outside follow the cage
//! as before; those of OutsidePoints::kExtend keep all their weights.
//! \param cage  rest cage of the weights
//! \return quality of the new weights
//! \throws OptionError for fewer than Dim + 1 influences; InputError if the mesh has no weights of
//! this name, or weights for another cage
template <class Mesh, int Dim>
Quality sparsify(Mesh& mesh, const PointList<Dim>& cage, Index most,
                 const ReductionOptions& options = {}) {
  auto rows = internal::rows_in(mesh, options.weights);
  rows.cage = internal::zeros(1, static_cast<std::size_t>(cage.cols()), Dim);
  rows.cage[0].matrix() = cage.transpose();
  const auto few = internal::binding_of<Dim>(mesh, rows, options.weights)
                       .reduced({most, options.threshold}, {}, options.reduction);
  internal::attach(mesh, few.weights, rows, most,
                   options.into.empty() ? options.weights : options.into);
  return measure_quality<Dim>(cage, few.points, few.weights);
}

//! The same with the rest cage stored by solve() or bind().
//! \throws InputError also if there is no rest cage
template <class Mesh>
Quality sparsify(Mesh& mesh, Index most, const ReductionOptions& options = {}) {
  const auto cage = get_rest_cage(mesh, options.weights);
  if constexpr (!std::is_same_v<Mesh, TetMesh>) {
    if (cage.rows() == 2) return sparsify(mesh, PointList<2>(cage), most, options);
  }
  if constexpr (kPointSize<Mesh> == 3) {
    if (cage.rows() == 3) return sparsify(mesh, PointList<3>(cage), most, options);
  }
  internal::refuse_rest_cage(static_cast<std::size_t>(cage.rows()), options.weights);
}

}  // namespace flbc::openmesh
