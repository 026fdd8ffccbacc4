// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Ends a run by a certified gap.
#pragma once

#include "solver/plan/choices.h"
#include "solver/plan/constants.h"
#include "solver/run/iteration.h"

namespace flbc {

//! Certifies the weights of an iteration at times that depend only on the number of iterations, so
//! runs are reproducible.
class GapCriterion {
 public:
  //! Certifies if due. \param made  iterations since the start \param last  whether this is the
  //! last iteration of the run \param error  estimated error of the weights relative to the
  //! tolerance
  //! \return whether the target is met
  template <int Dim>
  bool is_met(const plan::GapTarget& target, const Iteration<Dim>& iteration, int made, bool last,
              double error) {
    const bool due = made >= next_;
    if (target.gap == 0 || !(due || (last && made >= plan::kFirstCertified))) return false;
    if (due) next_ = static_cast<int>(plan::kCertifiedGrowth * made);
    const double gap = iteration.certify(iteration.weights().to_dense()).relative_gap;
    const bool waits = target.settles && error > plan::kSettled;
    return gap <= (waits ? plan::kSmallGap : target.gap);
  }

 private:
  int next_ = plan::kFirstCertified;
};

}  // namespace flbc
