// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/editing.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/messages.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "flbc/bounding_box.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "mesh/cell_geometry.h"
#include "problem/problem_geometry.h"
#include "solver/iterative_method.h"
#include "solver/multilevel/cascade.h"
#include "solver/multilevel/moving_distances.h"
#include "solver/multilevel/set_up.h"
#include "solver/run_state.h"
#include "solver/state_storage.h"
#include "solver/supports/choice.h"
#include "solver/warm_start/transfer.h"

namespace flbc {
namespace {

void validate(const EditBudget& budget) {
  if (budget.iterations < 0) {
    throw OptionError("iterations must be at least 1, or 0 for no limit of the budget's own, not " +
                      std::to_string(budget.iterations));
  }
  if (!(budget.seconds >= 0)) {
    throw OptionError("seconds must be positive, or 0 for no limit, not " +
                      format_number(budget.seconds));
  }
}

// Ends a run in time, and remembers that it did.
class Deadline {
 public:
  explicit Deadline(double seconds) : seconds_(seconds) {}

  void impose_on(SolverOptions& options) {
    if (seconds_ == 0) return;
    const auto interval = std::exchange(options.check_interval, 1);
    options.progress = [this, interval, progress = options.progress](const Progress& state) {
      if (progress && state.iteration % interval == 0 && !progress(state)) return false;
      elapsed_ += watch_.lap();
      passed_ = elapsed_ >= seconds_;
      return !passed_;
    };
  }

  bool passed() const { return passed_; }

 private:
  double seconds_;
  Stopwatch watch_;
  double elapsed_ = 0;
  bool passed_ = false;
};

// \throws InputError if a cell turned over, or has as good as no measure left
template <int Dim>
void refuse_folds(const DomainMesh<Dim>& before, const DomainMesh<Dim>& after) {
  constexpr double kLeast = 1e-9;  // of the cell's measure before
  const double enlargement =
      std::pow(bounding_box_diagonal(after.points) / bounding_box_diagonal(before.points), Dim);
  for (Index s = 0; s < after.num_cells(); ++s) {
    if (signed_measure(after, s) > kLeast * enlargement * signed_measure(before, s)) continue;
    throw InputError("cell " + std::to_string(s) + " of the domain mesh, at " +
                     format_point(centroid(before.points, before.cells, s)) +
                     ", would turn over; move the control points less far, or mesh the cage anew");
  }
}

template <int Dim>
void require_points_for(const Cage<Dim>& cage, const PointList<Dim>& control_points) {
  if (control_points.cols() == cage.size()) return;
  throw InputError(std::to_string(control_points.cols()) +
                   " control points were given for a cage that has " + std::to_string(cage.size()));
}

}  // namespace

// All that belongs to one shape of the cage.
template <int Dim>
struct EditableCoordinates<Dim>::Shape {
  Cage<Dim> cage;  // as the user gave it
  DomainMesh<Dim> mesh;
  LbcProblem<Dim> problem;
  DistanceReport distances{};  // behind its phi
  MeshState<Dim> state{};
  Solution solution{};
};

template <int Dim>
class EditableCoordinates<Dim>::State {
 public:
  State(Cage<Dim> cage, DomainMesh<Dim> mesh, const SolverOptions& options,
        const CoarseMesher<Dim>& mesher)
      : options_(offering_nothing(resolve(options))) {
    const ThreadScope threads(threads_for(options_.threads, cage.size(), mesh.num_vertices()));
    normalize_and_validate(mesh);
    std::optional<CoarseProblem<Dim>> coarsest;
    auto ready = set_up(cage, mesh, options_, mesher, &coarsest);
    if (coarsest) distances_.emplace(std::move(*coarsest), ready.problem);
    Shape shape{std::move(cage), std::move(mesh), std::move(ready.problem), ready.distances};
    solve_first(shape, std::move(ready.coarse));
    shape.solution.report.seconds.setup = ready.seconds;
    present_ = std::move(shape);
    anchor();
  }

  void move(const PointList<Dim>& control_points, const EditBudget& budget) {
    const ThreadScope threads(num_threads());
    Stopwatch watch;
    Deadline deadline(budget.seconds);
    auto shape = moved(control_points);
    const double setup = watch.lap();
    const auto transfer =
        Transfer<Dim>::between_shapes(present_.problem, present_.state, shape.problem);
    kept_.forget();
    solve(shape, &transfer, budget, deadline);
    shape.solution.report.seconds.setup = setup;
    present_ = std::move(shape);
  }

  void refine(const EditBudget& budget) {
    const ThreadScope threads(num_threads());
    Deadline deadline(budget.seconds);
    // After a solve that failed the kept state is of no use.
    const auto transfer =
        Transfer<Dim>::between_shapes(present_.problem, present_.state, present_.problem);
    solve(present_, kept_.penalty() > 0 ? nullptr : &transfer, budget, deadline);
  }

  void anchor() {
    anchor_mesh_ = present_.mesh;
    anchor_weights_ = present_.solution.weights;
    if (distances_) distances_->anchor(present_.mesh, anchor_weights_);
  }

  const Shape& present() const { return present_; }

 private:
  int num_threads() const {
    return threads_for(options_.threads, present_.problem.num_control_points(),
                       present_.mesh.num_vertices());
  }

  // The mesh where the control points take it, not solved yet.
  Shape moved(const PointList<Dim>& control_points) {
    require_points_for(present_.cage, control_points);
    Cage<Dim> cage{control_points, present_.cage.facets};
    validate(cage);
    DomainMesh<Dim> mesh{deform<Dim>(anchor_weights_, control_points), present_.mesh.cells};
    refuse_folds(anchor_mesh_, mesh);
    auto problem =
        make_geometry(cage, mesh, present_.problem.topology, present_.problem.boundary);
    Shape shape{std::move(cage), std::move(mesh), std::move(problem)};
    if (minimises(options_.method)) set_phi(shape);
    return shape;
  }

  void set_phi(Shape& shape) {
    auto& problem = shape.problem;
    auto distances = distances_ ? (*distances_)(problem, options_, shape.distances)
                                : distances_for(options_.phi, problem);
    problem.phi = {options_.phi, std::move(distances), problem.mesh, problem.num_control_points()};
  }

  // Arrays of all pairs are kept for refine(); what works on supports goes on from their state.
  StateStorage* storage_for(const Shape& shape) {
    return supports::serve(shape.problem, options_) ? nullptr : &kept_;
  }

  void solve_first(Shape& shape, std::vector<CoarseProblem<Dim>> coarse) {
    auto run = solve_in_cascade(shape.problem, std::move(coarse), options_, storage_for(shape),
                                inherits(options_.method) ? &shape.state : nullptr);
    shape.solution = finish<Solution>(shape.problem, options_, std::move(run));
    shape.solution.report.distances = shape.distances;
  }

  // Leaves the shape as it was if it throws.
  void solve(Shape& shape, const Transfer<Dim>* start, const EditBudget& budget,
             Deadline& deadline) {
    auto options = options_;
    if (budget.iterations > 0) {
      options.max_iterations = std::min(options.max_iterations, budget.iterations);
    }
    deadline.impose_on(options);
    SolveReport report;
    MeshState<Dim> state;
    WarmStart<Dim> warm_start;
    if (inherits(options.method)) warm_start = {start, &state};
    try {
      auto result = run_method(shape.problem, options, report, storage_for(shape), warm_start);
      if (deadline.passed()) report.status = SolveStatus::kIterationLimit;
      shape.solution =
          finish<Solution>(shape.problem, options, {std::move(result), std::move(report)});
      shape.solution.report.distances = shape.distances;
      shape.state = std::move(state);
    } catch (...) {
      kept_.forget();
      throw;
    }
  }

  SolverOptions options_;  // resolved
  Shape present_;
  KeptState kept_;  // of the present shape's iteration
  std::optional<MovingDistances<Dim>> distances_;
  DomainMesh<Dim> anchor_mesh_;
  WeightMatrix anchor_weights_;
};

template <int Dim>
EditableCoordinates<Dim>::EditableCoordinates(Cage<Dim> cage, DomainMesh<Dim> mesh,
                                              const SolverOptions& options,
                                              const CoarseMesher<Dim>& mesher) {
  require_valid_set_up(options, bool(mesher));
  refuse_state(options);
  state_ = std::make_unique<State>(std::move(cage), std::move(mesh), options, mesher);
}

template <int Dim>
EditableCoordinates<Dim>::~EditableCoordinates() = default;
template <int Dim>
EditableCoordinates<Dim>::EditableCoordinates(EditableCoordinates&&) noexcept = default;
template <int Dim>
EditableCoordinates<Dim>& EditableCoordinates<Dim>::operator=(EditableCoordinates&&) noexcept =
    default;

template <int Dim>
const Solution& EditableCoordinates<Dim>::move(const PointList<Dim>& control_points,
                                               const EditBudget& budget) {
  validate(budget);
  state_->move(control_points, budget);
  return solution();
}

template <int Dim>
const Solution& EditableCoordinates<Dim>::refine(const EditBudget& budget) {
  validate(budget);
  state_->refine(budget);
  return solution();
}

template <int Dim>
void EditableCoordinates<Dim>::anchor() {
  state_->anchor();
}

template <int Dim>
const Solution& EditableCoordinates<Dim>::solution() const {
  return state_->present().solution;
}

template <int Dim>
const Cage<Dim>& EditableCoordinates<Dim>::cage() const {
  return state_->present().cage;
}

template <int Dim>
const DomainMesh<Dim>& EditableCoordinates<Dim>::mesh() const {
  return state_->present().mesh;
}

template class EditableCoordinates<2>;
template class EditableCoordinates<3>;

}  // namespace flbc
