// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Stopping by the certified gap.
#pragma once

#include "solver/plan/constants.h"
#include "solver/run/iteration.h"

namespace flbc {

//! Certifies the weights of an iteration from time to time. The number of iterations alone decides
//! when, so that runs are repeatable.
class GapCriterion {
 public:
  //! \param wanted  relative gap, 0 = none is small enough
  explicit GapCriterion(double wanted) : wanted_(wanted) {}

  //! Certifies if it is time to. \param made  iterations of the run \param last  whether no other
  //! follows \return whether the gap is proved to be at most the one wanted
  template <int Dim>
  bool is_met(const Iteration<Dim>& iteration, int made, bool last);

 private:
  double wanted_;
  int next_ = plan::kFirstCertified;
};

}  // namespace flbc
