// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Runs on one mesh, each from where the one before ended.
#pragma once

#include <utility>
#include <vector>

#include "solver/multilevel/cascade.h"
#include "solver/state_storage.h"
#include "solver/supports/choice.h"

namespace flbc {

//! The state that the last run has left: the arrays of the iteration, or, if it worked on supports,
//! weights and duals.
template <int Dim>
class LastRun {
 public:
  bool is_there() const { return resumes(&arrays_) || has_state(); }

  //! The next run starts afresh.
  void forget() {
    arrays_.forget();
    state_ = {};
  }

  //! Runs from there. After an exception the state is of no use.
  //! \param coarse  to start from where no run was, coarsest first \param options  resolved
  MethodRun go_on(const LbcProblem<Dim>& problem, std::vector<CoarseProblem<Dim>> coarse,
                  const SolverOptions& options) {
    const bool on_supports = supports::serve(problem, options) && !resumes(&arrays_);
    StateStorage* storage = on_supports ? nullptr : &arrays_;
    MeshState<Dim> state;
    auto* final_state = on_supports ? &state : nullptr;
    auto run = has_state()
                   ? from_state(problem, options, storage, final_state)
                   : solve_in_cascade(problem, std::move(coarse), options, storage, final_state);
    state_ = std::move(state);
    return run;
  }

 private:
  bool has_state() const { return state_.weights.num_points() > 0; }

  MethodRun from_state(const LbcProblem<Dim>& problem, const SolverOptions& options,
                       StateStorage* storage, MeshState<Dim>* final_state) {
    const auto start = Transfer<Dim>::between_shapes(problem, state_, problem);
    MethodRun run;
    run.result = run_method(problem, options, run.report, storage, {&start, final_state});
    return run;
  }

  KeptState arrays_;
  MeshState<Dim> state_;
};

}  // namespace flbc
