// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The Jacobians of poses at points of a model, from a mesh of the interior.
#pragma once

#include <utility>
#include <vector>

#include "flbc/gradients.h"
#include "flbc/interpolate.h"

namespace flbc::app {

//! Smooth Jacobians. They cost little per pose: they are made at the vertices of the mesh and
//! interpolated.
template <int Dim>
class DomainJacobians {
 public:
  //! For no points.
  DomainJacobians() = default;

  //! \param weights  at the vertices of `domain`
  DomainJacobians(const Cage<Dim>& cage, DomainMesh<Dim> domain, const SparseWeights& weights,
                  const Placement<Dim>& placement)
      : domain_(std::move(domain)),
        gradients_(vertex_gradients(domain_, weights)),
        places_(places_in_mesh(cage, domain_, placement)) {}

  //! (Dim Dim) x P, as jacobians(). \param pose  Dim x n
  Eigen::MatrixXd at(const PointList<Dim>& pose) const {
    if (places_.empty()) return {};
    return interpolate<Dim>(domain_, jacobians(gradients_, pose), places_).dense();
  }

 private:
  DomainMesh<Dim> domain_;
  SparseWeights gradients_;  // at its vertices
  std::vector<Location<Dim>> places_;
};

}  // namespace flbc::app
