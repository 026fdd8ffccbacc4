// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Stopping by the certified gap.
#pragma once

#include <functional>

#include "flbc/certificate.h"

namespace flbc {

//! The first iteration at which it may certify.
constexpr int kFirstCertified = 500;

//! Certifies the weights of an iteration now and then. When is a matter of iterations alone, never
//! of time, so that runs are repeatable.
class GapCriterion {
 public:
  //! \param wanted  relative gap, 0 = none is small enough \param certify  certificate of the
  //! present weights by the present duals
  GapCriterion(double wanted, std::function<Certificate()> certify);

  //! Certifies if it is time to. \param last  whether no iteration follows
  //! \return whether the gap is proved to be at most the one wanted
  bool is_met(int iteration, bool last);

  //! Writes or reads what changes.
  template <class Archive>
  void visit(Archive& archive) {
    archive(next_);
  }

 private:
  double wanted_;
  std::function<Certificate()> certify_;
  int next_;
};

}  // namespace flbc
