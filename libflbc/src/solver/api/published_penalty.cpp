// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/published_penalty.h"

#include "flbc/bounding_box.h"
#include "solver/plan/choices.h"
#include "solver/plan/published_scale.h"

namespace flbc {

template <int Dim>
double published_penalty(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, Method method,
                         double penalty) {
  SolverOptions options;
  options.penalty = penalty;
  validate(options);
  if (method == Method::kAuto) method = resolve({}).method;
  const double size = plan::published_scale(mesh) * bounding_box_diagonal(cage.points);
  return penalty / plan::penalty_unit(method, Dim, size);
}

template double published_penalty(const Cage<2>&, const DomainMesh<2>&, Method, double);
template double published_penalty(const Cage<3>&, const DomainMesh<3>&, Method, double);

}  // namespace flbc
