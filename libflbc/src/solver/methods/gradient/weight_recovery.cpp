// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/gradient/weight_recovery.h"

#include "coordinates/poisson_weights.h"
#include "flbc/recovery.h"

namespace flbc::gradient {

template <int Dim>
const DirichletProblem<Dim>& WeightRecovery<Dim>::poisson() {
  if (!poisson_) poisson_.emplace(problem_.mesh, problem_.boundary, linear_solver_);
  return *poisson_;
}

template <int Dim>
WeightMatrix WeightRecovery<Dim>::harmonic() {
  return harmonic_coordinates(problem_, poisson());
}

template <int Dim>
template <class Scalar>
WeightMatrix WeightRecovery<Dim>::operator()(const CellFieldView<Scalar, Dim>& gradients) {
  return recovery_ == Recovery::kBreadthFirst
             ? integrate_breadth_first(problem_, gradients)
             : integrate_least_squares(problem_, gradients, poisson());
}

#define FLBC_INSTANTIATE(Scalar, Dim) \
  template WeightMatrix WeightRecovery<Dim>::operator()(const CellFieldView<Scalar, Dim>&);
template class WeightRecovery<2>;
template class WeightRecovery<3>;
FLBC_INSTANTIATE(float, 2)
FLBC_INSTANTIATE(float, 3)
FLBC_INSTANTIATE(double, 2)
FLBC_INSTANTIATE(double, 3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::gradient
