// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Stopping rules: estimated error, or the residuals of the paper.
#pragma once

#include <vector>

#include "solver/run/error_estimate.h"
#include "solver/run/iteration.h"

namespace flbc {

//! Residuals relative to their thresholds.
struct Ratios {
  double primal = 0, dual = 0;
};

//! Evaluates a run after each step.
template <int Dim>
class StopRule {
 public:
  virtual ~StopRule() = default;

  //! Iterations between two evaluations.
  virtual int interval() const { return plan::kCheckInterval; }

  //! Whether the last of them must measure residuals.
  virtual bool wants_residuals() const { return true; }

  //! Evaluates the last step. \param made  iterations since the start
  virtual Ratios judge(const Step& step, const Iteration<Dim>& iteration, int made,
                       double tolerance) = 0;
};

//! Method::kValue: the estimated mean squared error of the weights is at most the tolerance.
template <int Dim>
class EstimatedError final : public StopRule<Dim> {
 public:
  //! \param iteration  started \param in_double  whether it iterates in double precision
  //! \param origin  of its start \param looks  whether it adapts its penalty late
  EstimatedError(const LbcProblem<Dim>& problem, const Iteration<Dim>& iteration, bool in_double,
                 Origin origin, bool looks);

  int interval() const override { return 1; }
  bool wants_residuals() const override { return estimate_.wants_residual(); }
  Ratios judge(const Step& step, const Iteration<Dim>& iteration, int made,
               double tolerance) override;

 private:
  const double num_weights_, residual_scale_;
  ErrorEstimate estimate_;
  WeightHistory history_;
};

//! Method::kGradient: the same for periodically recovered weights.
template <int Dim>
class RecoveredError final : public StopRule<Dim> {
 public:
  //! Arguments as above.
  RecoveredError(const LbcProblem<Dim>& problem, const Iteration<Dim>& iteration, bool in_double);

  Ratios judge(const Step& step, const Iteration<Dim>& iteration, int made,
               double tolerance) override;

 private:
  const double residual_scale_;
  ErrorEstimate estimate_;
  WeightHistory history_;
  std::vector<double> errors_;  // of the last recoveries
};

//! Method::kPaper and kLbc2014: both residuals are below the thresholds of section 5 of the paper.
template <int Dim>
class PublishedCriterion final : public StopRule<Dim> {
 public:
  //! \param primal, dual  residuals in published units of length relative to those in problem units
  PublishedCriterion(double primal, double dual) : primal_(primal), dual_(dual) {}

  Ratios judge(const Step& step, const Iteration<Dim>&, int, double tolerance) override {
    constexpr double kDualToPrimal = 10;  // section 5 of the paper: N 1e-7 and N 1e-6
    return {primal_ * step.primal / tolerance, dual_ * step.dual / (kDualToPrimal * tolerance)};
  }

 private:
  const double primal_, dual_;
};

}  // namespace flbc
