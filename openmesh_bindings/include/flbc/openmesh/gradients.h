// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Gradients of weights as a property of the cells.
#pragma once

#include <string>

#include <Eigen/LU>

#include "flbc/openmesh/domain.h"
#include "flbc/openmesh/weights.h"

namespace flbc::openmesh {

namespace internal {

//! The gradients of piecewise linear functions on a cell. \return Dim x n
template <int Dim>
Eigen::Matrix<double, Dim, Eigen::Dynamic> gradients_on_cell(const DomainMesh<Dim>& mesh,
                                                             Index cell,
                                                             const SparseWeights& weights) {
  const auto vertices = mesh.cells.col(cell);
  Eigen::Matrix<double, Dim, Dim> edges;
  Eigen::Matrix<double, Dim, Eigen::Dynamic> differences(Dim, weights.num_control_points());
  const Eigen::VectorXd first = weights.at(vertices[0]);
  for (int k = 0; k < Dim; ++k) {
    edges.row(k) = mesh.points.col(vertices[k + 1]) - mesh.points.col(vertices[0]);
    differences.row(k) = weights.at(vertices[k + 1]) - first;
  }
  return edges.inverse() * differences;
}

template <int Dim, class Mesh>
void set_gradients(Mesh& mesh, const DomainMesh<Dim>& domain, const SparseWeights& weights,
                   const std::string& name) {
  using Handle = typename Elements<Mesh>::template CellProperty<Wide<double>>;
  const auto n = static_cast<std::size_t>(weights.num_control_points());
  auto& gradients = *attach_rows<Handle>(mesh, name, Dim, n).first;
  for (Index s = 0; s < domain.num_cells(); ++s) {
    gradients[s].matrix() = gradients_on_cell(domain, s, weights);
  }
}

}  // namespace internal

//! Attaches the gradients of the named weights to the cells, as Wide<double>: Dim rows of n values,
//! in 1 / units of the current mesh. The property name is gradients_name(weights). Replacing the
//! weights removes the gradients.
//! \param mesh  a TriMesh in the plane, or a TetMesh
//! \throws InputError if the mesh has no weights of this name, or if make_domain() throws
template <class Mesh>
void set_gradients(Mesh& mesh, const std::string& weights = kWeights) {
  internal::set_gradients(mesh, make_domain(mesh).mesh, get_weights(mesh, weights),
                          gradients_name(weights));
}

}  // namespace flbc::openmesh
