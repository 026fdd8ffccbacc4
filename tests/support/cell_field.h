// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Vectors per cell and control point in the layout of the solver.
#pragma once

#include "mesh/cell_geometry.h"
#include "support/test.h"

namespace flbc::testing {

//! Vectors of n control points, padded by three numbers of rubbish per component.
template <class Scalar, int Dim>
struct Field {
  std::vector<Scalar> numbers;
  CellFieldView<Scalar, Dim> view;

  Field(const DomainMesh<Dim>& mesh, Index n)
      : numbers(mesh.num_cells() * Dim * (n + 3), Scalar(1e30)),
        view{numbers.data(), static_cast<std::size_t>(n) + 3, n} {}
  Scalar& at(Index s, int d, Index i) { return numbers[(s * Dim + d) * view.stride + i]; }

  //! \param function  gives the vector of a cell and a control point
  template <class Function>
  Field& fill(const Function& function) {
    const auto cells = static_cast<Index>(numbers.size() / view.stride / Dim);
    for (Index s = 0; s < cells; ++s) {
      for (Index i = 0; i < view.n; ++i) {
        const Vector<Dim> value = function(s, i);
        for (int d = 0; d < Dim; ++d) at(s, d, i) = static_cast<Scalar>(value[d]);
      }
    }
    return *this;
  }
};

template <int Dim>
Vector<Dim> gradient_of(const DomainMesh<Dim>& mesh, const WeightMatrix& weights, Index s,
                        Index i) {
  return weight_gradients(mesh, s, cell_geometry(mesh, s), weights).row(i).transpose();
}

}  // namespace flbc::testing
