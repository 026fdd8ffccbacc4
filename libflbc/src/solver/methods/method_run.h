// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A method at work on one problem.
#pragma once

#include <functional>
#include <memory>

#include "solver/methods/active_set/active_lists.h"
#include "solver/run/iteration.h"
#include "solver/run/reporter.h"
#include "solver/run/stop_rule.h"
#include "solver/start/transfer.h"

namespace flbc {

//! How a method starts. Without `from` it starts cold.
template <int Dim>
struct WarmStart {
  const Transfer<Dim>* from = nullptr;  //!< duals of another mesh or shape, for methods that
                                        //!< plan::inherits() holds for
  const active_set::ColdStart<Dim>* cold = nullptr;  //!< if it was computed before
  std::function<void()> started{};                   //!< called when neither is needed any longer
  bool for_finer_mesh = false;  //!< the result is a finer mesh's start, for which a rough one does
};

//! Owns the iteration of a method, and hands over from the one on the active set to the one on all
//! pairs where that is needed. Keeps a reference to the problem.
template <int Dim>
class MethodRun {
 public:
  explicit MethodRun(const LbcProblem<Dim>& problem) : problem_(&problem) {}

  //! Solves, up to weights that may be negative: from the start the first time, afterwards from the
  //! present iteration.
  //! \param options  resolved \param report  is made anew
  //! \throws SolverError
  Weights solve(const SolverOptions& options, const Reporter& reporter, SolveReport& report,
                WarmStart<Dim> start = {});

  //! Certificate of weights (n x V) by the present duals.
  Certificate certify(const WeightMatrix& weights) const { return iteration_->certify(weights); }

  //! Whether the next solve continues from a present iteration.
  bool has_begun() const { return bool(iteration_); }

  //! Whether another mesh or shape can start from here.
  bool has_duals() const { return iteration_ && !iteration_->state().is_cold(); }

  //! Where another mesh or shape can start. \param least_weight  only where weights are above this;
  //! 0 for everywhere
  Duals<Dim> duals(double least_weight = 0) const;

 private:
  Weights iterate(const SolverOptions& options, const Reporter& reporter, SolveReport& report,
                  WarmStart<Dim> start);
  void begin(const SolverOptions& options, const WarmStart<Dim>& start);
  bool begin_on_active_set(const SolverOptions& options, const WarmStart<Dim>& start);
  void continue_on_all_pairs(const SolverOptions& options);
  std::unique_ptr<StopRule<Dim>> make_stop_rule(const SolverOptions& options, Origin origin) const;

  const LbcProblem<Dim>* problem_;
  std::unique_ptr<Iteration<Dim>> iteration_;
  bool is_active_ = false;
};

}  // namespace flbc
