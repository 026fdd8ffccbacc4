// SPDX-License-Identifier: BSD-3-Clause
#include "solver/gap_criterion.h"

#include <utility>

namespace flbc {
namespace {

// Most runs have met their tolerance by then.
// A certificate takes as long as some ten iterations, and a hundred are between two at least.
constexpr double kGrowth = 1.2;

}  // namespace

GapCriterion::GapCriterion(double wanted, std::function<Certificate()> certify)
    : wanted_(wanted), certify_(std::move(certify)), next_(kFirstCertified) {
}

bool GapCriterion::is_met(int iteration, bool last) {
  if (wanted_ == 0 || iteration < (last ? kFirstCertified : next_)) return false;
  next_ = static_cast<int>(kGrowth * iteration);
  return certify_().relative_gap <= wanted_;
}

}  // namespace flbc
