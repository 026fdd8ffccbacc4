// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Runs a method on one problem.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "solver/methods/active_set/active_lists.h"
#include "solver/run/run.h"
#include "solver/start/prolongation.h"

namespace flbc {

//! The start of a method; cold without `from`.
template <int Dim>
struct RunStart {
  const Prolongation<Dim>* from = nullptr;  //!< duals of another mesh, rest cage, or problem, for
                                            //!< methods with plan::inherits()
  const Prolongation<Dim>* supports =
      nullptr;                      //!< whose supports an active set has as well; or null
  std::function<void()> started{};  //!< called when it is not needed anymore
};

//! Makes the iteration of a method for a problem, to which it keeps a reference.
template <int Dim>
using MakeIteration = std::unique_ptr<Iteration<Dim>> (*)(const LbcProblem<Dim>& problem,
                                                          const plan::Settings& settings);

//! That of kGradient and kPaper, which iterate on meshes of OpenMesh: the component flbc::openmesh
//! sets it. Null in programs without the component.
template <int Dim>
MakeIteration<Dim>& gradient_iteration();

//! Owns the iteration of a method and the state of its run. Keeps a reference to the problem.
template <int Dim>
class MethodRun {
 public:
  explicit MethodRun(const LbcProblem<Dim>& problem) : problem_(&problem) {}

  //! Solves, without the final projection, so weights may be negative. The first call begins at the
  //! start. Later calls resume: a run in parts makes the same iterations as one in one piece. Only
  //! if a certificate is wanted after a run on an active set, the run starts over on all pairs.
  //!  \param report  reset
  //! \throws SolverError
  Weights solve(const plan::Settings& settings, const Reporter& reporter, SolveReport& report,
                RunStart<Dim> start = {});

  //! Certificate of weights (n x V) from the current duals.
  Certificate certify(const WeightMatrix& weights, Proof* proof) const {
    return iteration_->certify(weights, proof);
  }
  bool can_certify() const { return iteration_->can_certify(); }

  //! Whether the next solve resumes an iteration.
  bool has_begun() const { return bool(iteration_); }

  //! Whether another mesh or rest cage can start from here.
  bool has_warm_start() const { return iteration_ && !iteration_->state().is_cold(); }

  //! A start for another mesh or rest cage. \param least_weight  only where weights exceed this; 0
  //! for everywhere
  WarmStart<Dim> warm_start(double least_weight = 0) const;

 private:
  void begin(const plan::Settings& settings, const RunStart<Dim>& start);
  bool begin_on_active_set(const plan::Settings& settings, const RunStart<Dim>& start);
  StopRule make_stop_rule(const plan::Settings& settings) const;

  const LbcProblem<Dim>* problem_;
  std::unique_ptr<Iteration<Dim>> iteration_;
  std::optional<RunState> state_;
  bool is_active_ = false;
};

}  // namespace flbc
