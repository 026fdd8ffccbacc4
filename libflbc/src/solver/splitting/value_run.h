// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The loop of Method::kValue round its iteration.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "flbc/bounding_box.h"
#include "flbc/certificate.h"
#include "flbc/padded_rows.h"
#include "solver/iterative_method.h"
#include "solver/run_state.h"
#include "solver/splitting/compact_splitting.h"
#include "solver/splitting/error_estimate.h"

namespace flbc {

//! The penalty grows to no more than this: what is balanced are lengths of all that moves, and
//! where the start is nearly right everywhere, as on round cages, that takes the penalty out of the
//! range in which the rest converges.
template <int Dim>
double largest_penalty(const LbcProblem<Dim>& problem) {
  return bounding_box_diagonal(problem.cage.points) / 30;
}

//! Why an iteration of a run was left.
enum class Outcome {
  kEnded,
  kPaused,   //!< where it was told to
  kTrembles  //!< half precision does no longer; it is to go on in single precision
};

//! Iterations of a part of a run: with which it may end, after which it pauses, and after which the
//! part has begun.
struct Window {
  int earliest;
  int pause;
  int since;
};

//! The front of a state: how the run was going on.
struct StateFront {
  std::uint8_t on_supports = 0;  // flags as bytes: a file may hold any
  std::uint8_t is_half = 0;
  double penalty = 0;
  splitting::Start start = splitting::Start::kCold;
  int earliest = 0;  // of the window
  int since = 0;

  template <class Archive>
  void visit(Archive& archive) {
    archive(on_supports, is_half, penalty, start, earliest, since);
  }
};

//! \return none where there is no state to go on from
inline std::optional<StateFront> take_front(ByteReader& read) {
  if (read.is_at_end()) return std::nullopt;
  StateFront front;
  front.visit(read);
  using splitting::Start;
  require_undamaged(front.penalty > 0 && std::isfinite(front.penalty) &&
                    (front.start == Start::kCold || front.start == Start::kCoarserMesh ||
                     front.start == Start::kNearby));
  return front;
}

//! A run from its start to its end, which may go on in another precision or on other supports on
//! the way.
template <class Scalar, int Dim>
class ValueRun {
 public:
  //! \param measure  of the domain \param adaptive  whether the penalty is to be balanced
  //! \param start  of the first iteration, also of a run that goes on from a state
  ValueRun(const LbcProblem<Dim>& problem, double measure, const SolverOptions& options,
           bool adaptive, splitting::Start start, SolveReport& report)
      : problem_(problem),
        options_(options),
        adaptive_(adaptive),
        start_(start),
        report_(report),
        num_weights_(
            std::max(1.0, static_cast<double>(problem.boundary.interior_vertices().size())) *
            problem.num_control_points()),
        residual_scale_(square(bounding_box_diagonal(problem.cage.points)) /
                        (problem.num_control_points() * measure)),
        estimate_(start, Dim, options.tolerance),
        gap_(*options.gap, [this] { return certificate_(); }) {}

  //! Goes on from the part of a state that is the run's, the last one.
  void resume(ByteReader& read) {
    start_history();
    visit(read);
    require_whole_state(read, report_, options_);
  }

  //! \param certify_weights  by the duals of the splitting
  template <class Splitting>
  Outcome iterate(Splitting& splitting,
                  const std::function<Certificate(const WeightMatrix&)>& certify_weights,
                  Window window) {
    constexpr int kFewest = 8;
    const auto options = told(splitting, window);
    certificate_ = [&] { return certify_weights(splitting.weights()); };
    const auto read = [&](Index v, Scalar* weights) { splitting.read_vertex(v, weights); };
    if (!history_) {
      start_history();
      (*history_)(0, read);
    }
    if (report_.iterations >= window.pause) return Outcome::kPaused;  // a state of that iteration
    for (;;) {
      if (Splitting::kStoresHalf && trembles()) return Outcome::kTrembles;
      const int iteration = ++report_.iterations;
      const auto step = step_at(iteration, splitting);
      const double difference = (*history_)(iteration, read) / problem_.num_control_points();
      report_.primal_residual = estimate_(iteration, step.change / num_weights_, difference,
                                          step.violation * residual_scale_) /
                                options_.tolerance;
      const bool shows_end = report_.primal_residual <= 1;
      const bool look = iteration == options_.max_iterations ||
                        (shows_end ? iteration >= std::max(kFewest, window.earliest)
                                   : iteration % options_.check_interval == 0);
      if (look && finished(iteration, options, gap_, report_)) return Outcome::kEnded;
      if (iteration >= window.pause) return Outcome::kPaused;
    }
  }

 private:
  static double square(double x) { return x * x; }

  void start_history() {
    history_.emplace(problem_.boundary.interior_vertices(),
                     padded(static_cast<std::size_t>(problem_.num_control_points())));
  }

  // Options whose progress callback may ask for the objective and the state.
  template <class Splitting>
  SolverOptions told(Splitting& splitting, Window window) {
    auto options = with_objective(problem_, options_, [&] { return splitting.weights(); });
    return offering(std::move(options), [&, window](ByteWriter& write) {
      StateFront{Splitting::kOnSupports, Splitting::kStoresHalf,
                 splitting.penalty(),    start_,
                 window.earliest,        window.since}
          .visit(write);
      if constexpr (Splitting::kOnSupports) {
        write(splitting.supports().start, splitting.supports().items);
      }
      splitting.visit(write);
      visit(write);
    });
  }

  template <class Archive>
  void visit(Archive& archive) {
    archive(report_.iterations, report_.primal_residual, report_.active_pairs.growths,
            report_.active_pairs.density);
    history_->visit(archive);
    estimate_.visit(archive);
    gap_.visit(archive);
  }

  template <class Splitting>
  compact::Step step_at(int iteration, Splitting& splitting) const {
    if constexpr (Splitting::kAdapts) {
      constexpr double kBalance = 0.3;
      const bool adapts = iteration == 5 || iteration == 10 || iteration == 20 || iteration == 40;
      if (adaptive_ && adapts) {
        return splitting.iterate_and_adapt(kBalance, largest_penalty(problem_));
      }
    }
    return estimate_.wants_residual() ? splitting.iterate_measured() : splitting.iterate();
  }

  // Duals that are rounded in every iteration make the weights tremble, of which the estimate of
  // the error cannot tell that it leads nowhere.
  bool trembles() const {
    constexpr int kLongest = 300;
    constexpr double kSmallest = 1e-6;
    if (report_.iterations == 0) return false;
    return report_.iterations >= kLongest ||
           std::max(report_.primal_residual, 1.0) * options_.tolerance < kSmallest;
  }

  const LbcProblem<Dim>& problem_;
  const SolverOptions& options_;
  const bool adaptive_;
  const splitting::Start start_;
  SolveReport& report_;
  const double num_weights_;
  const double residual_scale_;
  splitting::ErrorEstimate estimate_;
  std::optional<splitting::WeightHistory<Scalar>> history_;
  std::function<Certificate()> certificate_;
  GapCriterion gap_;
};

}  // namespace flbc
