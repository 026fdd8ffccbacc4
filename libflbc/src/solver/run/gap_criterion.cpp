// SPDX-License-Identifier: BSD-3-Clause
#include "solver/run/gap_criterion.h"

namespace flbc {

template <int Dim>
bool GapCriterion::is_met(const Iteration<Dim>& iteration, int made, bool last) {
  if (wanted_ == 0 || made < (last ? plan::kFirstCertified : next_)) return false;
  if (!iteration.is_certifiable()) return false;
  next_ = static_cast<int>(plan::kCertifiedGrowth * made);
  return iteration.certify(iteration.weights().to_dense()).relative_gap <= wanted_;
}

template bool GapCriterion::is_met(const Iteration<2>&, int, bool);
template bool GapCriterion::is_met(const Iteration<3>&, int, bool);

}  // namespace flbc
