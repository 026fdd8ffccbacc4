// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Method::kValue where only supports of weights are stored and computed.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "solver/splitting/value_run.h"
#include "solver/supports/choice.h"
#include "solver/supports/support_splitting.h"
#include "solver/warm_start/dual_start.h"

namespace flbc::supports {

//! Iteration after which a run from harmonic coordinates balances its penalty for the last time.
constexpr int kLastBalance = 40;

//! Where an iteration on supports has come to.
template <int Dim>
struct LastState {
  bool ended = false;       //!< whether the run has ended; otherwise it is to go on with all pairs
  SparseWeights weights{};  //!< of V points, if it has
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

  //! Chooses the penalty itself, by how far weights move from where they started.
  //! \param weights  of the start, of an interior vertex \param part  of the penalty of all pairs
  void balance_from(VectorsAt<1> weights, double part) {
    start_weights_ = std::move(weights);
    part_ = part;
  }

  //! \param penalty  rho > 0 \param window  iterations with which the run may and has to end
  //! \param started  called when the start is needed no longer
  template <class Stored>
  LastState<Dim> run(DualStart<Dim> start, double penalty, SupportLists lists, Window window,
                     const std::function<void()>& started);

  //! Goes on from a state. \param penalty, lists, window  of the state
  //! \param read  fills the splitting and the run
  template <class Stored>
  LastState<Dim> resume(double penalty, SupportLists lists, Window window,
                        const std::function<void(SupportSplitting<Scalar, Stored, Dim>&)>& read);

 private:
  template <class Stored>
  using Splitting = SupportSplitting<Scalar, Stored, Dim>;

  template <class Stored>
  std::shared_ptr<Splitting<Stored>> make(const DualStart<Dim>& start, double penalty,
                                          SupportLists lists) const;
  template <class Stored>
  LastState<Dim> advance(std::shared_ptr<Splitting<Stored>> splitting, Window window);
  template <class Stored>
  bool reaches_ends(const Splitting<Stored>& splitting) const;
  int latest() const;
  int next_balance(int since) const;
  double balanced_penalty(const DualStart<Dim>& state);

  const LbcProblem<Dim>& problem_;
  const splitting::Metric& metric_;
  const SolverOptions& options_;
  ValueRun<Scalar, Dim>& run_;
  SolveReport& report_;
  VectorsAt<1> start_weights_;  // null where the penalty stays
  double part_ = 1;
};

}  // namespace flbc::supports
