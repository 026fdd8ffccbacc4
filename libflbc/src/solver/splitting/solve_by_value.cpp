// SPDX-License-Identifier: BSD-3-Clause
// Method::kValue from start to weights.
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "base/stopwatch.h"
#include "flbc/bounding_box.h"
#include "flbc/certificate.h"
#include "solver/iterative_method.h"
#include "solver/linear_solver_choice.h"
#include "solver/run_state.h"
#include "solver/splitting/compact_splitting.h"
#include "solver/splitting/value_run.h"
#include "solver/state_storage.h"
#include "solver/supports/cold_start.h"
#include "solver/supports/iterate_on_supports.h"
#include "solver/warm_start/dual_start.h"

namespace flbc {
namespace {

// The coarser the mesh, the more roundings of duals move the weights; and small meshes are fast as
// they are.
template <int Dim>
bool takes_half(const LbcProblem<Dim>& problem, const SolverOptions& options,
                const StateStorage* storage) {
  constexpr Index kFewestCells = 10000;
  return options.precision == Precision::kHalf && problem.mesh.num_cells() >= kFewestCells &&
         (storage == nullptr || storage->holds_half());
}

// A solve in the arithmetic of `Scalar`, on all pairs of vertices and control points and on
// supports in turn.
template <class Scalar, int Dim>
class ValueSolve {
 public:
  ValueSolve(const LbcProblem<Dim>& problem, const SolverOptions& options, SolveReport& report,
             StateStorage* storage, const WarmStart<Dim>& warm_start)
      : problem_(problem),
        options_(options),
        report_(report),
        storage_(storage),
        warm_start_(warm_start),
        read_(options.resume_from),
        front_(take_front(read_)),
        metric_(
            splitting::measure_metric(problem, options.non_negative == NonNegative::kConstraint)),
        run_(problem, metric_.cell.sum(), options, is_adaptive(), origin(), report) {
    report.iterations = 0;
    if (warm_start.from) start_ = start_of(*warm_start.from);
  }

  template <class Stored>
  MethodResult solve() {
    if (front_) return go_on<Stored>();
    if (storage_ == nullptr && supports::serve(problem_, options_)) {
      if (auto result = on_supports<Stored>()) return std::move(*result);
    }
    return on_all_pairs<Stored>();
  }

 private:
  template <class Stored>
  using Splitting = compact::CompactSplitting<Scalar, Stored, Dim>;

  splitting::Start origin() const {
    if (front_) return front_->start;
    if (warm_start_.from == nullptr) return splitting::Start::kCold;
    return warm_start_.from->is_between_shapes() ? splitting::Start::kNearby
                                                 : splitting::Start::kCoarserMesh;
  }
  bool is_adaptive() const {
    return options_.penalty == 0 && !resumes(storage_) && origin() == splitting::Start::kCold;
  }

  // A fortieth of the cage's size suits everywhere, roughly; adapt_penalty() does the rest.
  double choose_penalty() const {
    if (front_) return front_->penalty;
    if (resumes(storage_)) return storage_->penalty();
    if (options_.penalty > 0) return options_.penalty;
    if (start_) return start_->penalty;
    return bounding_box_diagonal(problem_.cage.points) / 40;
  }

  // Frees the coarser mesh's state or the other iteration, which the start refers to.
  void forget_start() {
    start_.reset();
    if (warm_start_.started) warm_start_.started();
    warm_start_.started = nullptr;
  }

  template <class Stored>
  MethodResult on_all_pairs() {
    constexpr int kRichardsonSteps = 8;
    const auto splitting = std::make_shared<Splitting<Stored>>(
        problem_, metric_, choose_penalty(), options_.relaxation,
        linear_solver_for(problem_, options_), storage_);
    if (front_) {
      splitting->visit(read_);
      run_.resume(read_);
      front_.reset();
    } else if (resumes(storage_)) {
      splitting->resume();
    } else if (start_) {
      splitting->start_from_duals(start_->weights, start_->flux_density,
                                  start_->vertex_dual_at(splitting->penalty()));
    } else {
      splitting->start_from_harmonic(kRichardsonSteps);
    }
    forget_start();
    return advance(splitting);
  }

  template <class Stored>
  MethodResult advance(std::shared_ptr<Splitting<Stored>> splitting) {
    const auto outcome = run_.iterate(*splitting, certify_by(splitting), {earliest_, kNever, 0});
    return outcome == Outcome::kEnded ? end(std::move(splitting))
                                      : advance(in_single(std::move(splitting)));
  }

  template <class Stored>
  std::shared_ptr<Splitting<Scalar>> in_single(std::shared_ptr<Splitting<Stored>> splitting) {
    if constexpr (Splitting<Stored>::kStoresHalf) {
      return std::make_shared<Splitting<Scalar>>(std::move(*splitting), storage_);
    } else {
      return splitting;
    }
  }

  // \return supports of the start
  supports::SupportLists start_cold() {
    auto cold = warm_start_.cold
                    ? *warm_start_.cold
                    : supports::cold_start(problem_, linear_solver_for(problem_, options_));
    start_ = cold.state();
    return std::move(cold.supports);
  }

  // A coarse mesh has told then where weights are.
  Window window_of(bool cold) const {
    if (!cold) return {0, kNever, 0};
    return {kUntilDualsAreThere, warm_start_.for_finer_mesh ? kUntilDualsAreThere : kNever, 0};
  }

  // Of the penalty of all pairs. Where fewer weights move a smaller one serves, and a yet smaller
  // one where they are nearly right already; as measured.
  double part_of_penalty(bool cold) const { return options_.penalty > 0 ? 1 : cold ? 0.5 : 0.25; }

  // \return nothing if it has to go on with all pairs, from the start if there is one
  template <class Stored>
  std::optional<MethodResult> on_supports() {
    const bool cold = !start_;
    const double of_all_pairs = choose_penalty();
    auto lists = cold ? start_cold()
                      : supports::supports_from(problem_, *warm_start_.from,
                                                supports::threshold_for(options_.tolerance));
    if (!supports::pay(problem_, options_, lists)) {
      if (cold) start_.reset();
      return {};
    }
    supports::Iteration<Scalar, Dim> iteration(problem_, metric_, options_, run_, report_);
    const double part = part_of_penalty(cold);
    if (cold && options_.penalty == 0) iteration.balance_from(start_->weights, part);
    auto last =
        iteration.template run<Stored>(*std::exchange(start_, {}), part * of_all_pairs,
                                       std::move(lists), window_of(cold), [&] { forget_start(); });
    return after_supports(std::move(last), part);
  }

  // From a state.
  template <class Stored>
  MethodResult go_on() {
    earliest_ = front_->earliest;
    if (front_->on_supports) {
      if (auto result = go_on_with_supports<Stored>()) return std::move(*result);
    }
    return on_all_pairs<Stored>();
  }

  // \return nothing if it has to go on with all pairs
  template <class Stored>
  std::optional<MethodResult> go_on_with_supports() {
    const auto front = *front_;
    supports::SupportLists lists;
    read_(lists.start, lists.items);
    supports::require_supports(problem_, lists);
    supports::Iteration<Scalar, Dim> iteration(problem_, metric_, options_, run_, report_);
    const bool cold = front.start == splitting::Start::kCold;
    const double part = part_of_penalty(cold);
    if (cold && options_.penalty == 0 && front.since < supports::kLastBalance) {
      const auto start = supports::cold_start(problem_, linear_solver_for(problem_, options_));
      iteration.balance_from(start.state().weights, part);
    }
    auto last = iteration.template resume<Stored>(
        front.penalty, std::move(lists), {front.earliest, kNever, front.since},
        [&](supports::SupportSplitting<Scalar, Stored, Dim>& splitting) {
          splitting.visit(read_);
          run_.resume(read_);
          front_.reset();
        });
    return after_supports(std::move(last), part);
  }

  // \return nothing if it has to go on with all pairs
  std::optional<MethodResult> after_supports(supports::LastState<Dim> last, double part) {
    report_.penalty = last.state.penalty;
    last.state = with_penalty(last.state, last.state.penalty / part);
    if (!last.ended || options_.certify) {
      start_ = std::move(last.state);
      earliest_ = report_.iterations + kUntilDualsAreThere;
      return {};
    }
    if (warm_start_.final_state) *warm_start_.final_state = mesh_state(problem_, last.state);
    last.state = {};  // frees the iteration
    report_.seconds.solve = watch_.lap();
    return MethodResult{{}, {}, std::move(last.weights)};
  }

  template <class Stored>
  auto certify_by(const std::shared_ptr<Splitting<Stored>>& splitting) const {
    return [splitting, &problem = problem_](const WeightMatrix& weights) {
      return certify(problem, splitting->flux(), weights);
    };
  }

  // The part of the state that a finer mesh on supports will read.
  DualStart<Dim> handed_on(DualStart<Dim> start) const {
    if (!warm_start_.for_finer_mesh || !supports::serve(problem_, options_)) return start;
    const double finer_tolerance = options_.tolerance / options_.coarse_levels.looseness;
    start.flux_density =
        supports::where_weights_are(problem_, start, supports::threshold_for(finer_tolerance));
    return start;
  }

  // Leaves everything where it is wanted.
  template <class Stored>
  MethodResult end(std::shared_ptr<Splitting<Stored>> splitting) {
    report_.seconds.solve = watch_.lap();
    splitting->finish();
    report_.state_scalars_per_cell = splitting->state_scalars_per_cell();
    report_.penalty = splitting->penalty();
    if (storage_ != nullptr) storage_->keep_penalty(report_.penalty);
    if (warm_start_.final_state) {
      *warm_start_.final_state = mesh_state(
          problem_, handed_on(start_of<Dim>(std::shared_ptr<const Splitting<Stored>>(splitting))));
    }
    return {splitting->weights(), certify_by(splitting)};
  }

  static constexpr int kNever = std::numeric_limits<int>::max();
  // Iterations it takes duals to come from nothing, before which small changes do not tell a small
  // error.
  static constexpr int kUntilDualsAreThere = 100;

  Stopwatch watch_;
  const LbcProblem<Dim>& problem_;
  const SolverOptions& options_;
  SolveReport& report_;
  StateStorage* const storage_;
  WarmStart<Dim> warm_start_;
  ByteReader read_;
  std::optional<StateFront> front_;  // until it has been gone on from
  const splitting::Metric metric_;
  ValueRun<Scalar, Dim> run_;
  std::optional<DualStart<Dim>> start_;
  int earliest_ = 0;  // iteration with which it may end on all pairs
};

}  // namespace

template <int Dim>
MethodResult solve_by_value(const LbcProblem<Dim>& problem, const SolverOptions& options,
                            SolveReport& report, StateStorage* storage, WarmStart<Dim> warm_start) {
  if (options.precision == Precision::kDouble) {
    return ValueSolve<double, Dim>(problem, options, report, storage, warm_start)
        .template solve<double>();
  }
  ByteReader read(options.resume_from);
  const auto front = take_front(read);
  const bool half = front ? front->is_half : takes_half(problem, options, storage);
  ValueSolve<float, Dim> solve(problem, options, report, storage, warm_start);
  return half ? solve.template solve<compact::Half>() : solve.template solve<float>();
}

template MethodResult solve_by_value(const LbcProblem<2>&, const SolverOptions&, SolveReport&,
                                     StateStorage*, WarmStart<2>);
template MethodResult solve_by_value(const LbcProblem<3>&, const SolverOptions&, SolveReport&,
                                     StateStorage*, WarmStart<3>);

}  // namespace flbc
