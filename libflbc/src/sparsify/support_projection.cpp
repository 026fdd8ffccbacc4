// SPDX-License-Identifier: BSD-3-Clause
#include "sparsify/support_projection.h"

namespace flbc {

template <int Dim>
bool SupportProjection<Dim>::project(const Vector<Dim>& point, const std::vector<Index>& support,
                                     const Eigen::VectorXd& given, Eigen::VectorXd& weights) const {
  const WeightProjection<Dim> projection(control_points_(Eigen::all, support));
  typename WeightProjection<Dim>::Workspace work(projection);
  Eigen::VectorXd few = given(support);
  if (projection.project(point, few, work) > 0) return false;
  weights.setZero(given.size());
  weights(support) = few;
  return all_.is_feasible(point, weights);
}

template class SupportProjection<2>;
template class SupportProjection<3>;

}  // namespace flbc
