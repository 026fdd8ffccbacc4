// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Starts a solve from the solution on the coarse mesh.
#pragma once

#include "flbc/options.h"
#include "solver/methods/method_run.h"
#include "solver/multilevel/coarse_problem.h"

namespace flbc {

//! The solution of the coarse problem, from which the iteration on the problem starts.
template <int Dim>
class CoarseStart {
 public:
  //! Solves the coarse problem to the end, so that the start does not depend on a budget. Keeps a
  //! reference to `problem`.
  CoarseStart(const LbcProblem<Dim>& problem, CoarseProblem<Dim> coarse,
              const plan::Settings& settings, const Reporter& reporter);

  //! Refers to this object, which releases the coarse problem when the iteration has started.
  //! \param given  start from this, and take only supports from the coarse problem; or null
  RunStart<Dim> start(const Prolongation<Dim>* given);

  //! Whether the observer has stopped it. One iteration is then left, for weights on the mesh.
  bool stopped() const { return stopped_; }

  //! Completes the report of the run that started here. \param weights  its result
  void describe(const Weights& weights, SolveReport& report) const;

 private:
  const LbcProblem<Dim>& problem_;
  std::optional<LbcProblem<Dim>> coarse_;
  std::vector<std::array<Index, 2>> ends_;
  WarmStart<Dim> warm_start_{};
  SparseWeights weights_{};
  std::optional<Prolongation<Dim>> prolongation_{};
  LevelReport level_{};
  bool stopped_ = false;
};

}  // namespace flbc
