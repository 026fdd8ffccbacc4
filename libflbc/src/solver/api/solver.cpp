// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "base/messages.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "base/stage_progress.h"
#include "base/stopwatch.h"
#include "coordinates/poisson_weights.h"
#include "flbc/bounding_box.h"
#include "flbc/deform.h"
#include "flbc/domain_mesh.h"
#include "flbc/errors.h"
#include "flbc/quality.h"
#include "mesh/cell_geometry.h"
#include "polytope/mask_conflicts.h"
#include "polytope/project_columns.h"
#include "problem/problem_geometry.h"
#include "solver/api/moved_mesh.h"
#include "solver/api/solve_parts.h"
#include "solver/multilevel/coarse_problem.h"
#include "solver/multilevel/coarse_start.h"
#include "solver/plan/choices.h"
#include "solver/plan/settings.h"
#include "solver/run/run.h"
#include "solver/start/prolongation.h"

namespace flbc {
namespace {

void require_factors(const std::vector<double>& reach, Index control_points) {
  if (reach.empty() || static_cast<Index>(reach.size()) == control_points) return;
  throw OptionError("reach needs a factor for each of the " + std::to_string(control_points) +
                    " control points, not " + std::to_string(reach.size()) + " factors");
}

void require_valid(const SolverOptions& options, Index control_points) {
  validate(options);
  require_factors(options.reach, control_points);
  if (options.active_set == ActiveSet::kOn && control_points > plan::kMostActiveControlPoints) {
    throw OptionError("active_set on is for at most " +
                      std::to_string(plan::kMostActiveControlPoints) + " control points, not " +
                      std::to_string(control_points) + "; choose active_set auto");
  }
}

template <int Dim>
void require_objective(const LbcProblem<Dim>& problem, const plan::Settings& settings) {
  check_phi(problem.phi, problem.num_control_points(), problem.mesh.num_cells());
  if (problem.smoothness != *settings.smoothness) {
    throw OptionError("the problem was made with smoothness " + format_number(problem.smoothness) +
                      ", and the options say " + format_number(*settings.smoothness));
  }
}

// The masks of interior vertices. Those of others end here, because their weights are known.
// \param control_points, points  of the mesh, in the units of messages
template <int Dim>
PointMasks masks_inside(const PointList<Dim>& control_points, const PointList<Dim>& points,
                        const BoundaryValues<Dim>& boundary, const std::vector<Mask>& masks) {
  if (masks.empty()) return {};
  const auto n = static_cast<Index>(control_points.cols());
  const auto count = static_cast<Index>(points.cols());
  const auto is_interior = [&](Index v) { return boundary.is_interior(v); };
  PointMasks inside(PointMasks(masks, n, count).list(is_interior), n, count);
  refuse_mask_conflicts(control_points, points, inside);
  return inside;
}

template <int Dim>
void require_one_part(const DomainMesh<Dim>& mesh, const SolverOptions& options) {
  if (options.masks.empty() || count_parts(mesh) == 1) return;
  throw OptionError("masks are for cages in one part; solve each part on its own");
}

template <int Dim>
int num_threads(const LbcProblem<Dim>& problem, const plan::Settings& settings) {
  return threads_for(settings.threads, problem.num_control_points(), problem.mesh.num_vertices());
}

// \param negligible  smaller weights become 0
template <int Dim>
SparseWeights made_non_negative(const LbcProblem<Dim>& problem, const Weights& weights,
                                double negligible) {
  return project_columns<Dim>(
      problem.cage.points, problem.mesh.points, problem.boundary.interior_vertices(),
      [&](Index v) -> Eigen::VectorXd {
        if (weights.is_sparse()) return weights.sparse.at(v);
        return weights.dense.col(v);
      },
      problem.masks, negligible);
}

// The criteria of the published methods say little about the error.
double negligible_weight(const plan::Settings& settings) {
  return settings.method == Method::kWeights ? plan::kNegligible * std::sqrt(*settings.tolerance)
                                             : 0;
}

template <int Dim>
Certificate certify(const LbcProblem<Dim>& problem, const MethodRun<Dim>& run,
                    const WeightMatrix& weights, Proof* proof) {
  auto certificate = run.certify(weights, proof);
  certificate.objective = unscaled(problem, certificate.objective);
  // Rounding in the division by the power of the scale must not increase the bound.
  constexpr double kRoundings = 4 * std::numeric_limits<double>::epsilon();
  certificate.lower_bound = unscaled(problem, certificate.lower_bound) * (1 - kRoundings);
  if (proof != nullptr) {
    proof->multipliers *= std::pow(problem.scale, 2 - Dim);
    proof->smoothness /= problem.scale;
  }
  return certificate;
}

// Whether to certify the solution: a gap was asked for, or a small change may be far from the
// optimum, as without smoothness.
bool certifies(const plan::Settings& settings, const SolveReport& report) {
  if (settings.certify || *settings.gap > 0) return true;
  return report.criterion == Criterion::kTolerance && *settings.smoothness == 0 &&
         settings.non_negative != NonNegative::kOff;
}

//! Makes a solution from the weights of a run: projection, certificate, measures.
template <int Dim>
Solution finish(const LbcProblem<Dim>& problem, const MethodRun<Dim>& run, Weights weights,
                const plan::Settings& settings, const Reporter& reporter, SolveReport report) {
  Stopwatch watch;
  const bool is_splitting =
      settings.method == Method::kWeights || settings.method == Method::kLbc2014;
  // Weights of the splitting have the precision of its iteration.
  if (is_splitting && settings.non_negative == NonNegative::kOff) {
    weights.is_sparse() ? project_interior(problem, weights.sparse)
                        : project_interior(problem, weights.dense);
  }
  Solution solution;
  if (settings.non_negative != NonNegative::kOff) {
    const StageScope scope(reporter.stage(Stage::kNonNegative));
    solution.weights = made_non_negative(problem, weights, negligible_weight(settings));
  } else {
    solution.weights = std::move(weights).to_sparse();
  }
  weights = {};
  report.seconds.recover += watch.lap();
  if (run.can_certify() && certifies(settings, report)) {
    const StageScope scope(reporter.stage(Stage::kCertificate));
    const auto proof = settings.certify ? std::make_shared<Proof>() : nullptr;
    report.certificate = certify(problem, run, solution.weights.dense(), proof.get());
    report.certificate.proof = proof;
  }
  report.seconds.certify = watch.lap();
  report.objective = unscaled(problem, objective(problem, solution.weights));
  report.quality = measure_quality(problem.cage.points, problem.mesh.points, solution.weights);
  solution.report = std::move(report);
  return solution;
}

// Distances of a moved cage may become exact, those of a new one must be as asked for.
template <int Dim>
void require_distances(const NestedProblem<Dim>& ready, const plan::Settings& settings) {
  if (settings.distances != Distances::kInterpolated || settings.phi == DistanceScheme::kConstant ||
      ready.distances.source == Distances::kInterpolated) {
    return;
  }
  throw OptionError(
      "distances cannot be interpolated on this mesh, which was not made by refine(); choose "
      "distances auto");
}

void validate(const Budget& budget) {
  if (budget.iterations < 0) {
    throw OptionError("iterations must be at least 1, or 0 for no separate limit, not " +
                      std::to_string(budget.iterations));
  }
  if (!(budget.seconds >= 0)) {
    throw OptionError("seconds must be positive, or 0 for no limit, not " +
                      format_number(budget.seconds));
  }
}

template <int Dim>
void require_points_for(const Cage<Dim>& cage, const PointList<Dim>& control_points) {
  if (control_points.cols() == cage.size()) return;
  throw InputError(std::to_string(control_points.cols()) +
                   " control points were given for a cage that has " + std::to_string(cage.size()));
}

// Options that stay the same during a run. All others take effect when it resumes, except for
// masks, reach, and falloff, for which another run begins. Names all options, so that a new one
// cannot be forgotten.
auto fixed_in_a_run(const SolverOptions& options) {
  const auto& [method, phi, smoothness, distances, precision, non_negative, tolerance, gap,
               active_set, max_iterations, penalty, certify, masks, reach, falloff, threads] =
      resolve(options);
  return std::tuple(method, phi, smoothness, distances, precision, non_negative, active_set,
                    penalty);
}

}  // namespace

bool tries_active_set(int dim, Index control_points, Index vertices, const SolverOptions& options) {
  return plan::active_set({dim, control_points, vertices, !options.masks.empty()},
                          plan::settings_of(options));
}

template <int Dim>
struct internal::SolverState {
  using MasksIn = typename Solver<Dim>::MasksIn;

  // The state for one rest cage; the run refers to the problem.
  struct Shape : NestedProblem<Dim> {
    Cage<Dim> cage;  // as given by the caller
    DomainMesh<Dim> mesh;
    double setup_seconds = 0;  // until reported
    std::optional<MethodRun<Dim>> run{};
  };

  // A solved shape by whose weights the mesh follows the control points.
  struct Reference {
    DomainMesh<Dim> mesh;
    SparseWeights weights;

    // \throws InputError if a cell would be inverted
    DomainMesh<Dim> moved(const PointList<Dim>& control_points) const {
      return moved_mesh<Dim>(mesh, weights, control_points);
    }
  };

  // Sets up the problem of a rest cage, as a new Solver does.
  // \param topology  of the mesh; null if not known
  void begin(Cage<Dim> cage, DomainMesh<Dim> mesh, const MeshTopology<Dim>* topology,
             const SolverOptions& given, const Observer& observer = {}) {
    require_valid(given, cage.size());
    require_connected(mesh);
    const ThreadScope threads(threads_for(given.threads, cage.size(), mesh.num_vertices()));
    const Stopwatch watch;
    const auto settings = plan::settings_of(given);
    auto geometry =
        topology == nullptr ? make_geometry(cage, mesh) : make_geometry(cage, mesh, *topology);
    geometry.masks = masks_inside(cage.points, mesh.points, geometry.boundary, given.masks);
    auto ready = set_up_shape(cage, mesh, std::move(geometry), settings, observer);
    require_distances<Dim>(*ready, settings);
    shape = std::move(ready);
    shape->setup_seconds = watch.seconds();
    options = given;
    warm_start.reset();
  }

  // Sets masks, reach, and falloff. With another reach or falloff the next solve starts over, which
  // takes fewer iterations than a warm start; with other masks it starts from the present state.
  void change_problem(const SolverOptions& given) {
    auto& [problem, coarse, distances] = static_cast<NestedProblem<Dim>&>(*shape);
    auto masks =
        masks_inside(shape->cage.points, shape->mesh.points, problem.boundary, given.masks);
    if (given.reach != options.reach || given.falloff != options.falloff) {
      warm_start.reset();
    } else if (!warm_start && shape->run->has_warm_start()) {
      warm_start = shape->run->warm_start();
    }
    coarse.reset();  // has those before
    problem.masks = std::move(masks);
    problem.phi.set_reach(given.reach);
    set_falloff(problem, given.falloff);
    shape->run.emplace(problem);
  }

  static std::unique_ptr<Shape> set_up_shape(Cage<Dim> cage, DomainMesh<Dim> mesh,
                                             LbcProblem<Dim> geometry,
                                             const plan::Settings& settings,
                                             const Observer& observer) {
    auto shape =
        std::make_unique<Shape>(Shape{set_up(std::move(geometry), settings, Reporter(observer)),
                                      std::move(cage), std::move(mesh)});
    shape->run.emplace(shape->problem);
    return shape;
  }

  // Whether phi of the present problem is not what a new Solver would use, or is too inaccurate.
  bool needs_other_phi(const SolverOptions& given) const {
    const auto& [source, vertices, error] = shape->distances;
    return source == Distances::kInterpolated &&
           !plan::interpolates(plan::settings_of(given), error);
  }

  std::shared_ptr<const Reference> present() const {
    return std::make_shared<Reference>(Reference{shape->mesh, solution.weights});
  }

  // The mesh moved by the control points, not solved yet.
  // \param by  becomes the present shape if the mesh cannot follow this one
  // \param masks_in  may be null \param masks  receives those of the moved mesh
  std::unique_ptr<Shape> moved(const PointList<Dim>& control_points, const plan::Settings& settings,
                               std::shared_ptr<const Reference>& by, const MasksIn& masks_in,
                               std::vector<Mask>& masks, const Observer& observer) {
    require_points_for(shape->cage, control_points);
    Cage<Dim> cage{control_points, shape->cage.facets};
    validate(cage);
    DomainMesh<Dim> moved;
    try {
      moved = by->moved(control_points);
    } catch (const InputError&) {
      // Cells that are inverted on the way from there may not be on the way from here.
      by = present();
      moved = by->moved(control_points);
    }
    masks = masks_in ? masks_in(cage, moved) : options.masks;
    auto geometry = make_geometry(cage, moved, shape->problem.topology, shape->problem.boundary);
    geometry.masks = masks_inside(cage.points, moved.points, geometry.boundary, masks);
    return set_up_shape(std::move(cage), std::move(moved), std::move(geometry), settings, observer);
  }

  // Solves from the start, or resumes the run. The solution is unchanged if it throws.
  // \param spent  seconds of the budget \param keeps_supports  whether weights of an active set are
  // zero where those of the start are
  void solve_on(Shape& on, const Prolongation<Dim>* start, bool keeps_supports,
                const Budget& budget, double spent, const Observer& observer) {
    const auto settings = plan::settings_of(options);
    const Reporter reporter(observer);
    const ThreadScope threads(num_threads(on.problem, settings));
    std::optional<CoarseProblem<Dim>> coarse;
    if (!on.run->has_begun() && (start == nullptr || !keeps_supports)) {
      coarse = std::exchange(on.coarse, std::nullopt);
      if (!coarse) coarse = coarse_problem(on.problem, settings);
    }
    auto within = settings;
    if (budget.iterations > 0)
      within.max_iterations = std::min(within.max_iterations, budget.iterations);
    const auto limited =
        budget.seconds > 0 ? reporter.with_limit(budget.seconds - spent) : reporter;
    std::optional<CoarseStart<Dim>> coarse_start;
    if (coarse) coarse_start.emplace(on.problem, *std::move(coarse), settings, reporter);
    if (coarse_start && coarse_start->stopped()) within.max_iterations = 1;
    SolveReport report;
    auto weights = on.run->solve(within, limited, report,
                                 coarse_start ? coarse_start->start(start) : RunStart<Dim>{start});
    if (coarse_start) coarse_start->describe(weights, report);
    solution =
        finish(on.problem, *on.run, std::move(weights), settings, reporter, std::move(report));
    solution.report.seconds.setup = std::exchange(on.setup_seconds, 0);
    solution.report.distances = on.distances;
  }

  SolverOptions options;
  std::unique_ptr<Shape> shape{};
  Solution solution{};
  std::shared_ptr<const Reference> reference{};  // none before the first move
  std::optional<WarmStart<Dim>> warm_start{};    // of the masks before, for the next solve
};

template <int Dim>
Solution solve(LbcProblem<Dim> problem, const SolverOptions& given, const Observer& observer) {
  auto options = given;
  if (!options.smoothness) options.smoothness = problem.smoothness;
  require_valid(options, problem.num_control_points());
  require_objective(problem, plan::settings_of(options));
  if (!options.masks.empty() && problem.masks.empty()) {
    problem.masks =
        masks_inside(problem.cage.points, problem.mesh.points, problem.boundary, options.masks);
    if (problem.masks.empty()) options.masks.clear();
  }
  if (!options.reach.empty()) problem.phi.set_reach(options.reach);
  if (options.falloff > 0) set_falloff(problem, options.falloff);
  using State = internal::SolverState<Dim>;
  State state{options, std::make_unique<typename State::Shape>()};
  state.shape->problem = std::move(problem);
  state.shape->run.emplace(state.shape->problem);
  state.solve_on(*state.shape, nullptr, true, {}, 0, observer);
  return std::move(state.solution);
}

// One solver per part. \param topology  of the whole mesh; null if not known
template <int Dim>
Solution solve_each_part(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                         const MeshTopology<Dim>* topology, const SolverOptions& options,
                         const Observer& observer) {
  validate(options);
  require_factors(options.reach, cage.size());
  require_one_part(mesh, options);
  const auto solve_part = [&](const Cage<Dim>& part, const DomainMesh<Dim>& domain,
                              const Observer& own, const std::vector<Index>& control_points,
                              bool stopped) {
    auto settings = options;
    settings.reach.clear();
    if (!options.reach.empty()) {
      for (const Index i : control_points) settings.reach.push_back(options.reach[i]);
    }
    if (stopped) settings.max_iterations = 1;
    internal::SolverState<Dim> state{settings};
    state.begin(part, domain, &domain == &mesh ? topology : nullptr, settings, own);
    state.solve_on(*state.shape, nullptr, true, {}, 0, own);
    if (stopped) state.solution.report.status = SolveStatus::kStopped;
    return std::move(state.solution);
  };
  return solve_parts<Dim>(cage, mesh, observer, solve_part);
}

template <int Dim>
Solution solve(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, const SolverOptions& options,
               const Observer& observer) {
  return solve_each_part<Dim>(cage, mesh, nullptr, options, observer);
}

template <int Dim>
Solution solve(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
               const MeshTopology<Dim>& topology, const SolverOptions& options,
               const Observer& observer) {
  return solve_each_part<Dim>(cage, mesh, &topology, options, observer);
}

template <int Dim>
Solver<Dim>::Solver(Cage<Dim> cage, DomainMesh<Dim> mesh, const SolverOptions& options,
                    const Observer& observer)
    : state_(std::make_unique<internal::SolverState<Dim>>(internal::SolverState<Dim>{options})) {
  normalize_and_validate(mesh);
  state_->begin(std::move(cage), std::move(mesh), nullptr, options, observer);
}

template <int Dim>
Solver<Dim>::~Solver() = default;
template <int Dim>
Solver<Dim>::Solver(Solver&&) noexcept = default;
template <int Dim>
Solver<Dim>& Solver<Dim>::operator=(Solver&&) noexcept = default;

template <int Dim>
const Solution& Solver<Dim>::solve(const Budget& budget, const Observer& observer) {
  validate(budget);
  try {
    auto& shape = *state_->shape;
    if (const auto warm_start = std::exchange(state_->warm_start, std::nullopt)) {
      const Prolongation<Dim> prolongation(shape.problem, *warm_start, shape.problem);
      const bool keeps_supports =
          !plan::active_set(plan::sizes_of(shape.problem), plan::settings_of(state_->options));
      state_->solve_on(shape, &prolongation, keeps_supports, budget, 0, observer);
    } else {
      state_->solve_on(shape, nullptr, true, budget, 0, observer);
    }
  } catch (...) {
    restart();
    throw;
  }
  return solution();
}

template <int Dim>
const Solution& Solver<Dim>::reshape(const PointList<Dim>& control_points, const Budget& budget,
                                     const Observer& observer, const MasksIn& masks_in) {
  validate(budget);
  auto& state = *state_;
  if (!state.shape->run->has_begun()) solve({}, observer);
  Stopwatch watch;
  const auto& before = *state.shape;
  const auto settings = plan::settings_of(state.options);
  const ThreadScope threads(num_threads(before.problem, settings));
  auto reference = state.reference ? state.reference : state.present();
  std::vector<Mask> masks;
  auto shape = state.moved(control_points, settings, reference, masks_in, masks, observer);
  shape->setup_seconds = watch.lap();
  const double spent = shape->setup_seconds;
  if (plan::inherits(settings.method) && before.run->has_warm_start()) {
    const auto warm_start = before.run->warm_start();
    const Prolongation<Dim> prolongation(before.problem, warm_start, shape->problem);
    state.solve_on(*shape, &prolongation, true, budget, spent, observer);
  } else {
    state.solve_on(*shape, nullptr, true, budget, spent, observer);
  }
  state.shape = std::move(shape);
  state.reference = std::move(reference);
  state.options.masks = std::move(masks);
  return solution();
}

template <int Dim>
void Solver<Dim>::set_options(const SolverOptions& options) {
  auto& state = *state_;
  require_valid(options, state.shape->cage.size());
  const bool has_solved = state.solution.weights.num_points() > 0;
  if (has_solved && fixed_in_a_run(options) == fixed_in_a_run(state.options) &&
      !state.needs_other_phi(options)) {
    const auto locality = [](const SolverOptions& of) {
      return std::tie(of.masks, of.reach, of.falloff);
    };
    if (locality(options) != locality(state.options)) {
      state.change_problem(options);
    }
    state.options = options;
  } else {
    state.begin(state.shape->cage, state.shape->mesh, &state.shape->problem.topology, options);
  }
}

template <int Dim>
void Solver<Dim>::restart() {
  state_->shape->run.emplace(state_->shape->problem);
  state_->warm_start.reset();
}

template <int Dim>
const SolverOptions& Solver<Dim>::options() const {
  return state_->options;
}

template <int Dim>
const Cage<Dim>& Solver<Dim>::cage() const {
  return state_->shape->cage;
}

template <int Dim>
const DomainMesh<Dim>& Solver<Dim>::mesh() const {
  return state_->shape->mesh;
}

template <int Dim>
const LbcProblem<Dim>& Solver<Dim>::problem() const {
  return state_->shape->problem;
}

template <int Dim>
const Solution& Solver<Dim>::solution() const {
  return state_->solution;
}

#define FLBC_INSTANTIATE(Dim)                                                                      \
  template Solution solve(LbcProblem<Dim>, const SolverOptions&, const Observer&);                 \
  template Solution solve<Dim>(const Cage<Dim>&, const DomainMesh<Dim>&, const SolverOptions&,     \
                               const Observer&);                                                   \
  template Solution solve<Dim>(const Cage<Dim>&, const DomainMesh<Dim>&, const MeshTopology<Dim>&, \
                               const SolverOptions&, const Observer&);                             \
  template class Solver<Dim>;
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
