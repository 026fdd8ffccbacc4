// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! When a run ends: by its estimated error, or by the paper's residuals.
#pragma once

#include <algorithm>
#include <vector>

#include "flbc/options.h"
#include "solver/run/error_estimate.h"
#include "solver/run/iteration.h"

namespace flbc {

//! Judges an iteration after each step. Keeps references to what its constructor gets.
template <int Dim>
class StopRule {
 public:
  virtual ~StopRule() = default;

  //! To be called before the first step, and again when another iteration takes over.
  virtual void begin(const Iteration<Dim>&) {}

  //! Iterations to make until the next judgment, >= 1. \param made  so far
  virtual int next(int made) const = 0;

  //! Whether the last of them has to measure its residuals.
  virtual bool wants_residuals() const = 0;

  //! Judges the last step: sets the residuals of the report, relative to their thresholds.
  //! \return whether the run may end now, or the caller is to be told
  virtual bool judge(const Step& step, const Iteration<Dim>& iteration, SolveReport& report) = 0;

  //! The run must not end before this iteration.
  void not_before(int iteration) { earliest_ = iteration; }

 protected:
  //! Whether to look: at each iteration that shows the end, else every check_interval iterations.
  bool looks(const SolverOptions& options, const SolveReport& report, int fewest) const {
    const int made = report.iterations;
    if (made >= options.max_iterations) return true;
    const bool shows_end = report.primal_residual <= 1 && report.dual_residual <= 1;
    return shows_end ? made >= std::max(fewest, earliest_) : made % options.check_interval == 0;
  }
  static int to_next_look(const SolverOptions& options, int made) {
    const int interval = options.check_interval;
    return std::min(interval - made % interval, options.max_iterations - made);
  }

 private:
  int earliest_ = 0;
};

//! Method::kValue: the estimated mean squared error of the weights is at most the tolerance.
template <int Dim>
class EstimatedError : public StopRule<Dim> {
 public:
  //! \param origin  of the first iteration
  EstimatedError(const LbcProblem<Dim>& problem, const SolverOptions& options, Origin origin);

  void begin(const Iteration<Dim>& iteration) override;
  int next(int) const override { return 1; }
  bool wants_residuals() const override { return estimate_.wants_residual(); }
  bool judge(const Step& step, const Iteration<Dim>& iteration, SolveReport& report) override;

 private:
  const SolverOptions& options_;
  const double num_control_points_, num_weights_, residual_scale_;
  ErrorEstimate estimate_;
  WeightHistory history_;
  bool begun_ = false;
};

//! Method::kGradient: the same for weights that are recovered from time to time.
template <int Dim>
class RecoveredError : public StopRule<Dim> {
 public:
  RecoveredError(const LbcProblem<Dim>& problem, const SolverOptions& options);

  void begin(const Iteration<Dim>& iteration) override;
  int next(int made) const override { return this->to_next_look(options_, made); }
  bool wants_residuals() const override { return true; }
  bool judge(const Step& step, const Iteration<Dim>& iteration, SolveReport& report) override;

 private:
  const LbcProblem<Dim>& problem_;
  const SolverOptions& options_;
  const int interval_;
  const double residual_scale_;
  ErrorEstimate estimate_;
  WeightMatrix weights_;        // of the last recovery
  std::vector<double> errors_;  // of the last recoveries
};

//! Method::kPaper and kLbc2014: both residuals are below the thresholds of section 5 of the paper.
template <int Dim>
class Residuals : public StopRule<Dim> {
 public:
  //! Residuals in published units of length relative to those in the problem's.
  struct Units {
    double primal, dual;
  };
  Residuals(const SolverOptions& options, Units units) : options_(options), units_(units) {}

  int next(int made) const override { return this->to_next_look(options_, made); }
  bool wants_residuals() const override { return true; }
  bool judge(const Step& step, const Iteration<Dim>& iteration, SolveReport& report) override;

 private:
  const SolverOptions& options_;
  const Units units_;
};

}  // namespace flbc
