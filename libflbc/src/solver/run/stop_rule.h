// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Stopping rules: estimated error, or the residuals of the paper.
#pragma once

#include <algorithm>
#include <vector>

#include "flbc/options.h"
#include "solver/run/error_estimate.h"
#include "solver/run/iteration.h"

namespace flbc {

//! Evaluates an iteration after each step. Keeps references to constructor arguments.
template <int Dim>
class StopRule {
 public:
  virtual ~StopRule() = default;

  //! Must be called before the first step, and when another iteration takes over.
  virtual void begin(const Iteration<Dim>&) {}

  //! Iterations until the next evaluation, >= 1. \param made  iterations so far
  virtual int next(int made) const = 0;

  //! Whether the last of them must measure residuals.
  virtual bool wants_residuals() const = 0;

  //! Evaluates the last step: sets the residuals of the report, relative to their thresholds.
  //! \return whether the run may end, or progress is due
  virtual bool judge(const Step& step, const Iteration<Dim>& iteration, SolveReport& report) = 0;

  //! The run must not end before this iteration.
  void not_before(int iteration) { earliest_ = iteration; }

 protected:
  //! Whether to evaluate: when the estimate would end the run, otherwise every check_interval
  //! iterations.
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
  //! \param origin  of the first iteration \param rough  whether the result is only a start for a
  //! finer mesh, so the run may end early
  EstimatedError(const LbcProblem<Dim>& problem, const SolverOptions& options, Origin origin,
                 bool rough = false);

  void begin(const Iteration<Dim>& iteration) override;
  int next(int) const override { return 1; }
  bool wants_residuals() const override { return estimate_.wants_residual(); }
  bool judge(const Step& step, const Iteration<Dim>& iteration, SolveReport& report) override;

 private:
  const SolverOptions& options_;
  const double num_weights_, residual_scale_;
  ErrorEstimate estimate_;
  WeightHistory history_;
  bool begun_ = false;
};

//! Method::kGradient: the same for periodically recovered weights.
template <int Dim>
class RecoveredError : public StopRule<Dim> {
 public:
  RecoveredError(const LbcProblem<Dim>& problem, const SolverOptions& options);

  void begin(const Iteration<Dim>& iteration) override;
  int next(int made) const override { return this->to_next_look(options_, made); }
  bool wants_residuals() const override { return true; }
  bool judge(const Step& step, const Iteration<Dim>& iteration, SolveReport& report) override;

 private:
  const SolverOptions& options_;
  const int interval_;
  const double residual_scale_;
  ErrorEstimate estimate_;
  WeightHistory history_;
  std::vector<double> errors_;  // of the last recoveries
};

//! Method::kPaper and kLbc2014: both residuals are below the thresholds of section 5 of the paper.
template <int Dim>
class Residuals : public StopRule<Dim> {
 public:
  //! Residuals in published units of length relative to those in problem units.
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
