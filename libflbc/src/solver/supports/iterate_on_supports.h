// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Method::kValue where only supports of weights are stored and computed.
#pragma once

#include <functional>
#include <memory>

#include "solver/splitting/value_run.h"
#include "solver/supports/choice.h"
#include "solver/supports/support_splitting.h"
#include "solver/warm_start/dual_start.h"

namespace flbc::supports {

//! Where an iteration on supports has come to.
template <int Dim>
struct LastState {
  bool ended = false;      //!< whether the run has ended; otherwise it is to go on with all pairs
  WeightMatrix weights{};  //!< n x V, if it has
  DualStart<Dim> state{};
};

//! Iterates on supports, which it extends where the weights reach their ends.
template <class Scalar, int Dim>
class Iteration {
 public:
  //! Keeps references. \param run  that it is a part of
  Iteration(const LbcProblem<Dim>& problem, const splitting::Metric& metric,
            const SolverOptions& options, ValueRun<Scalar, Dim>& run, SolveReport& report)
      : problem_(problem), metric_(metric), options_(options), run_(run), report_(report) {}

  //! \param penalty  rho > 0 \param started  called when the start is needed no longer
  template <class Stored>
  LastState<Dim> run(DualStart<Dim> start, double penalty, SupportLists lists,
                     const std::function<void()>& started);

 private:
  template <class Stored>
  using Splitting = SupportSplitting<Scalar, Stored, Dim>;

  template <class Stored>
  std::shared_ptr<Splitting<Stored>> make(const DualStart<Dim>& start, double penalty,
                                          SupportLists lists) const;
  template <class Stored>
  LastState<Dim> advance(std::shared_ptr<Splitting<Stored>> splitting, int earliest);
  template <class Stored>
  bool reaches_ends(const Splitting<Stored>& splitting) const;
  int latest() const;

  const LbcProblem<Dim>& problem_;
  const splitting::Metric& metric_;
  const SolverOptions& options_;
  ValueRun<Scalar, Dim>& run_;
  SolveReport& report_;
};

}  // namespace flbc::supports
