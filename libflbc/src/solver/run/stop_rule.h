// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Stopping rules: estimated error, or the residuals of the paper.
#pragma once

#include <deque>

#include "solver/run/iteration.h"

namespace flbc {

//! Estimates the mean squared distance of the weights to the limit of the iteration. Changes that
//! shrink by a factor r per iteration leave r / (1 - r) times the last one.
class ErrorEstimate {
 public:
  //! \param interval  iterations between two calls
  explicit ErrorEstimate(int interval = 1) : interval_(interval) {}

  //! \param change  mean squared change of a weight in the last iteration
  //! \return the estimate; not finite if the change is not
  double operator()(double change);

  //! Forgets all changes, because the iteration works on other pairs now.
  void restart() { *this = ErrorEstimate(interval_); }

 private:
  int interval_;
  int calls_ = 0;
  double first_ = 0;              // sum of the first changes of a circle
  std::deque<double> changes_{};  // the latest ones
};

//! Residuals relative to their thresholds.
struct Ratios {
  double primal, dual;
};

//! Evaluates a run after each step.
class StopRule {
 public:
  //! Method::kWeights and kGradient: the estimated mean squared error of the weights is at most the
  //! tolerance. \param per_change  mean squared change of a weight per Step::change
  //! \param interval  Iteration::interval()
  static StopRule estimate(double per_change, int interval) {
    return {true, per_change, 0, interval};
  }

  //! Method::kPaper and kLbc2014: both residuals are below the thresholds of section 5 of the
  //! paper. \param primal, dual  residuals in published units of length relative to those in
  //! problem units
  static StopRule residuals(double primal, double dual) { return {false, primal, dual, 1}; }

  //! \param counts  whether the step is the last of an interval; the changes of others are not kept
  Ratios judge(const Step& step, double tolerance, bool counts = true);

  void restart() { estimate_.restart(); }

 private:
  StopRule(bool estimates, double primal, double dual, int interval)
      : estimates_(estimates), primal_(primal), dual_(dual), estimate_(interval) {}

  bool estimates_;
  double primal_, dual_;
  ErrorEstimate estimate_;
};

}  // namespace flbc
