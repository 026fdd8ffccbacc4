// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/rig.h"

#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "base/messages.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "base/stopwatch.h"
#include "binding/solid.h"
#include "flbc/cage_facts.h"
#include "flbc/coordinates.h"
#include "flbc/errors.h"
#include "flbc/lbc_problem.h"
#include "flbc/mirror.h"
#include "flbc/pointwise.h"
#include "flbc/report.h"
#include "solver/api/moved_mesh.h"

namespace flbc {
namespace {

template <int Dim>
void require_valid(const BindOptions& options) {
  if (options.max_influences > 0) {
    validate<Dim>(SparsifyOptions{options.max_influences});
  } else if (options.max_influences < 0) {
    throw OptionError("max_influences must be positive, or 0 for all");
  }
  if (options.coordinates) {
    validate(*options.coordinates, {options.solver.non_negative, options.solver.threads});
    if (!options.masks.empty() || !options.solver.masks.empty() || !options.solver.reach.empty() ||
        options.solver.falloff != 0) {
      throw OptionError(
          std::string("masks, reach, and falloff are for local coordinates, not for ") +
          name_of(*options.coordinates));
    }
  } else {
    validate(options.solver);
  }
}

template <int Dim>
void require_points(const PointList<Dim>& points) {
  if (points.cols() == 0) throw InputError("the model has no vertices");
}

template <int Dim>
void require_model(const PointList<Dim>& points, const EdgeList& edges) {
  check_finite<Dim>(points);
  validate(edges, points.cols());
}

// \param mesh  may be empty
template <int Dim>
Placement<Dim> place_in(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                        const PointList<Dim>& points, OutsidePoints policy) {
  return mesh.num_cells() > 0 ? place_points(cage, mesh, points, policy)
                              : place_points(cage, points, policy);
}

// Points that nobody sees may be outside: they follow the nearest point of the cage.
template <int Dim>
Placement<Dim> place_unless_loose(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                                  const PointList<Dim>& points, const EdgeList& edges,
                                  OutsidePoints policy) {
  try {
    return place_in(cage, mesh, points, policy);
  } catch (const InputError&) {
    if (policy != OutsidePoints::kFail) throw;
    const auto usual = usual_policy(cage, points, edges);
    if (usual == policy) throw;
    return place_in(cage, mesh, points, usual);
  }
}

// What the weights do not reproduce.
template <int Dim>
PointList<Dim> offsets_of(const PointList<Dim>& points, const Placement<Dim>& placement) {
  if (placement.outside.empty() || placement.policy == OutsidePoints::kExtend) return {};
  PointList<Dim> offsets = PointList<Dim>::Zero(Dim, points.cols());
  for (const auto& [point, facet, coordinates, offset] : placement.outside) {
    offsets.col(point) =
        placement.policy == OutsidePoints::kKeep ? Vector<Dim>(points.col(point)) : offset;
  }
  return offsets;
}

// The masks of a model join those that the caller gave for the mesh.
SolverOptions solver_options(const BindOptions& options, const PlacedMasks& masks) {
  auto solver = options.solver;
  solver.masks.insert(solver.masks.end(), masks.of_mesh.begin(), masks.of_mesh.end());
  return solver;
}

// For people: what was asked for, where it is not left to the program.
std::string describe(const BindOptions& options) {
  const auto& solver = options.solver;
  std::string text;
  const auto add = [&](const char* name, const std::string& value) {
    text += (text.empty() ? "" : ", ") + std::string(name) + " " + value;
  };
  if (!options.coordinates) {
    const auto resolved = resolve(solver);
    add("smoothness", format_number(*resolved.smoothness));
    if (resolved.tolerance) add("tolerance", format_number(*resolved.tolerance));
    add("phi", options.phi.size() > 0 ? "given" : name_of(solver.phi));
    if (!solver.reach.empty()) add("reach", "given");
    if (solver.falloff > 0) add("falloff", format_number(solver.falloff));
  }
  if (options.max_influences > 0) add("influences", std::to_string(options.max_influences));
  return text;
}

// Whether a solution by some options is none by others.
bool differ(const BindOptions& a, const BindOptions& b) {
  const auto problem = [](const BindOptions& options) {
    const auto& solver = options.solver;
    return std::tuple(options.coordinates, options.masks, solver.method, solver.phi,
                      solver.smoothness, solver.tolerance, solver.non_negative, solver.reach,
                      solver.falloff, solver.masks);
  };
  return problem(a) != problem(b) || a.phi.size() != b.phi.size() ||
         (a.phi.size() > 0 && (a.phi.rows() != b.phi.rows() || a.phi != b.phi));
}

}  // namespace

template <int Dim>
void Rig<Dim>::begin() {
  require_model<Dim>(points_, edges_);
  require_valid<Dim>(options_);
  validate(cage_);
}

template <int Dim>
Rig<Dim>::Rig(Cage<Dim> cage, PointList<Dim> points, EdgeList edges, const BindOptions& options)
    : Rig(std::move(cage), MadeDomain<Dim>{}, std::move(points), std::move(edges), options) {
  require_points<Dim>(points_);
}

template <int Dim>
Rig<Dim>::Rig(Cage<Dim> cage, PointList<Dim> points, EdgeList edges, const BindOptions& options,
              const Meshers<Dim>& meshers)
    : cage_(std::move(cage)),
      points_(std::move(points)),
      edges_(std::move(edges)),
      options_(options) {
  begin();
  require_points<Dim>(points_);
  const ThreadScope threads(options_.solver.threads);
  if (options_.outside == OutsidePoints::kFail) {  // before a mesher starts
    place_unless_loose<Dim>(cage_, {}, points_, edges_, options_.outside);
  }
  const Stopwatch watch;
  MeshingOptions<Dim> meshing;
  meshing.vertices = options_.vertices;
  meshing.poll = options_.observer.poll;
  auto made = make_domain(cage_, meshing, meshers);
  report_.mesh_seconds = watch.seconds();
  take(std::move(made));
}

template <int Dim>
Rig<Dim>::Rig(Cage<Dim> cage, DomainMesh<Dim> domain, PointList<Dim> points, EdgeList edges,
              const BindOptions& options)
    : Rig(std::move(cage), MadeDomain<Dim>{(normalize_and_validate(domain), std::move(domain))},
          std::move(points), std::move(edges), options) {
  require_points<Dim>(points_);
}

template <int Dim>
Rig<Dim>::Rig(Cage<Dim> cage, MadeDomain<Dim> domain, PointList<Dim> points, EdgeList edges,
              const BindOptions& options)
    : cage_(std::move(cage)),
      points_(std::move(points)),
      edges_(std::move(edges)),
      options_(options) {
  begin();
  take(std::move(domain));
}

template <int Dim>
void Rig<Dim>::take(MadeDomain<Dim> domain) {
  mesh_ = std::move(domain.mesh);
  report_.mesher = std::move(domain.mesher);
  report_.note = std::move(domain.note);
  const auto& coordinates = options_.coordinates;
  if (mesh_.num_cells() == 0 && (!coordinates || !is_pointwise(*coordinates))) {
    throw OptionError("these coordinates need a domain mesh");
  }
  placed_ = place(cage_, mesh_, points_, edges_, options_);
}

template <int Dim>
typename Rig<Dim>::Placed Rig<Dim>::place(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                                          const PointList<Dim>& points, const EdgeList& edges,
                                          const BindOptions& options) {
  const ThreadScope threads(options.solver.threads);
  const Stopwatch watch;
  Placed placed;
  if (points.cols() > 0) {
    placed.placement = place_unless_loose(cage, mesh, points, edges, options.outside);
  } else {
    placed.placement.points = mesh.points;
  }
  constrain(placed, cage, mesh, points, options);
  placed.seconds = watch.seconds();
  return placed;
}

template <int Dim>
void Rig<Dim>::constrain(Placed& placed, const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                         const PointList<Dim>& points, const BindOptions& options) {
  if (options.mirror_axis >= 0 && !placed.mirror) {
    if (points.cols() == 0) throw OptionError("mirror_axis is for weights of a model");
    placed.mirror.emplace(cage, options.mirror_axis, points);
    placed.mirror->symmetrize(placed.placement, [&](const PointList<Dim>& images) {
      return place_points(cage, images, without_failure(options.outside)).points;
    });
  }
  placed.masks = {};
  const auto& [placement, mirror, unused, seconds] = placed;
  if (!options.solid.empty() && points.cols() == 0) {
    throw OptionError("solid regions are for weights of a model");
  }
  if (!options.masks.empty()) {
    const auto masks = mirror ? mirror->symmetrized(options.masks) : options.masks;
    const auto images = mirror ? mirror->images() : std::vector<Index>{};
    placed.masks = place_masks(cage, mesh, placement, masks, images);
    if (mirror) mirror->keep_common(masks, placed.masks);
  }
  if (!options.solid.empty()) require_solid(frame(cage, placed, options));
}

template <int Dim>
Binding<Dim> Rig<Dim>::frame(const Cage<Dim>& cage, const Placed& placed,
                             const BindOptions& options) {
  Binding<Dim> binding;
  const auto& [placement, mirror, masks, seconds] = placed;
  binding.cage = cage;
  binding.points = placement.points;
  binding.masks = masks.of_all();
  binding.solid = options.solid;
  if (mirror) binding.mirror = mirror->mirror();
  binding.policy = placement.policy;
  for (const auto& vertex : placement.outside) binding.outside.push_back(vertex.point);
  return binding;
}

template <int Dim>
bool Rig<Dim>::keeps_solver() const {
  return !options_.coordinates && options_.phi.size() == 0 && cage_parts(cage_).size() == 1;
}

// Solves in one run, of which no state remains.
template <int Dim>
Solution Rig<Dim>::solve_at_once(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                                 const Placed& placed) const {
  const auto& observer = options_.observer;
  if (options_.coordinates && mesh.num_cells() > 0) {
    const auto& solver = options_.solver;
    return compute_coordinates(cage, mesh, *options_.coordinates,
                               {solver.non_negative, solver.threads}, observer);
  }
  if (options_.coordinates) {
    Solution solution;  // weights_of_points() evaluates
    solution.report.control_points = cage.size();
    solution.report.objective = std::numeric_limits<double>::quiet_NaN();
    return solution;
  }
  const auto options = solver_options(options_, placed.masks);
  if (options_.phi.size() == 0) return flbc::solve(cage, mesh, options, observer);
  auto problem = make_problem(cage, mesh, DistanceScheme::kConstant, *resolve(options).smoothness);
  problem.phi = WeightFunctions(options_.phi);
  return flbc::solve(std::move(problem), options, observer);
}

template <int Dim>
const Solution& Rig<Dim>::solve(const Budget& budget) {
  if (is_given_) return solution_;
  const Stopwatch watch;
  if (!keeps_solver()) {
    solution_ = solve_at_once(cage_, mesh_, placed_);
  } else if (solver_) {
    solver_->solve(budget, options_.observer);
  } else {
    auto solver = std::make_unique<Solver<Dim>>(
        cage_, mesh_, solver_options(options_, placed_.masks), options_.observer);
    solver->solve(budget, options_.observer);
    solver_ = std::move(solver);
  }
  drop_weights();
  report_.solve_seconds = watch.seconds();
  return solution();
}

template <int Dim>
void Rig<Dim>::set_solution(Solution solution) {
  check_size(solution.weights, cage_.size(), mesh().num_vertices());
  if (solver_) {
    cage_ = solver_->cage();
    mesh_ = solver_->mesh();
    solver_.reset();
  }
  is_given_ = solution.report.status == SolveStatus::kConverged;
  solution_ = std::move(solution);
  drop_weights();
}

template <int Dim>
const Solution& Rig<Dim>::reshape(const PointList<Dim>& control_points, const Budget& budget) {
  if (cage_parts(cage_).size() > 1) {
    throw InputError(
        "a cage with several parts cannot be reshaped; bind the model to the new cage");
  }
  const bool has_mesh = mesh().num_cells() > 0;
  require_solution();
  Placed placed;
  const auto place_in = [&](const Cage<Dim>& cage, const DomainMesh<Dim>& mesh) {
    placed = place(cage, mesh, points_, edges_, options_);
    return solver_options(options_, placed.masks);
  };
  if (solver_) {
    solver_->reshape(
        control_points, budget, options_.observer,
        [&](const auto& cage, const auto& mesh) { return place_in(cage, mesh).masks; });
  } else {
    Cage<Dim> moved{control_points, cage_.facets};
    validate(moved);
    auto mesh = has_mesh ? moved_mesh<Dim>(mesh_, solution_.weights, control_points) : mesh_;
    const auto options = place_in(moved, mesh);
    std::unique_ptr<Solver<Dim>> solver;
    Solution solution;
    if (keeps_solver()) {
      solver = std::make_unique<Solver<Dim>>(moved, mesh, options, options_.observer);
      solver->solve(budget, options_.observer);
    } else {
      solution = solve_at_once(moved, mesh, placed);
    }
    cage_ = std::move(moved);
    mesh_ = std::move(mesh);
    solver_ = std::move(solver);
    solution_ = std::move(solution);
    is_given_ = false;
  }
  placed_ = std::move(placed);
  drop_weights();
  return solution();
}

template <int Dim>
void Rig<Dim>::set_model(PointList<Dim> points, EdgeList edges) {
  require_points<Dim>(points);
  require_model<Dim>(points, edges);
  auto placed = place(cage(), mesh(), points, edges, options_);
  if (solver_ && !options_.masks.empty()) {
    solver_->set_options(solver_options(options_, placed.masks));
  }
  placed_ = std::move(placed);
  points_ = std::move(points);
  edges_ = std::move(edges);
  few_ = {};
  drop_weights();
}

template <int Dim>
void Rig<Dim>::set_options(const BindOptions& options) {
  require_valid<Dim>(options);
  std::optional<Placed> changed;
  const bool has_other_mirror = options.mirror_axis != options_.mirror_axis;
  if (options.outside != options_.outside || (has_other_mirror && placed_.mirror)) {
    changed = place(cage(), mesh(), points_, edges_, options);
  } else if (has_other_mirror || options.masks != options_.masks ||
             options.solid != options_.solid) {
    changed = placed_;
    constrain(*changed, cage(), mesh(), points_, options);
  }
  const bool is_local = !options.coordinates && options.phi.size() == 0;
  if (solver_ && is_local) {
    const auto& masks = changed ? changed->masks : placed_.masks;
    solver_->set_options(solver_options(options, masks));
  } else if (solver_) {
    auto solution = solver_->solution();
    solution.report.status = SolveStatus::kStopped;
    set_solution(std::move(solution));
  }
  if (differ(options_, options)) {
    is_given_ = false;
    drop_weights();
  }
  if (options.max_influences != options_.max_influences ||
      options.reduction != options_.reduction) {
    few_ = {};
    is_reduced_ = false;
  }
  options_ = options;
  if (!changed) return;
  placed_ = std::move(*changed);
  drop_weights();
}

template <int Dim>
SparseWeights Rig<Dim>::evaluated(const Placement<Dim>& placement) const {
  if (options_.coordinates && is_pointwise(*options_.coordinates)) {
    const auto& solver = options_.solver;
    return pointwise_coordinates(cage(), placement, *options_.coordinates,
                                 solver.non_negative == NonNegative::kProject, solver.threads);
  }
  return weights_at(cage(), mesh(), solution().weights, placement);
}

template <int Dim>
void Rig<Dim>::require_solution() {
  if (mesh().num_cells() > 0 && solution().weights.num_points() == 0) solve();
}

template <int Dim>
const SparseWeights& Rig<Dim>::weights_of_points() {
  if (weights_.num_points() > 0) return weights_;
  require_solution();
  const auto& [placement, mirror, masks, seconds] = placed_;
  if (points_.cols() == 0 && masks.masked == 0) return solution().weights;
  const ThreadScope threads(options_.solver.threads);
  const Stopwatch watch;
  auto weights = points_.cols() > 0 ? evaluated(placement) : solution().weights;
  if (masks.masked > 0) weights = enforce_masks(cage(), placement, weights, masks);
  if (mirror) {
    weights = mirror->symmetrized(weights, [&](const PointList<Dim>& points) {
      return evaluated(place_in<Dim>(cage(), mesh(), points, without_failure(options_.outside)));
    });
    if (masks.masked > 0) {
      weights = enforce_masks(cage(), placement, weights, mirror->of_single_points(masks));
    }
  }
  if (!options_.solid.empty()) {
    auto whole = frame(cage(), placed_, options_);
    whole.edges = edges_;
    whole.weights = std::move(weights);
    make_solid(whole);
    weights = std::move(whole.weights);
  }
  weights_ = std::move(weights);
  report_.evaluate_seconds = seconds + watch.seconds();
  return weights_;
}

template <int Dim>
Binding<Dim> Rig<Dim>::binding() {
  const ThreadScope threads(options_.solver.threads);
  auto binding = frame(cage(), placed_, options_);
  binding.weights = weights_of_points();
  const auto& placement = placed_.placement;
  binding.offsets = offsets_of(points_, placement);
  binding.edges = points_.cols() > 0 ? edges_ : edges_of_cells(mesh());
  binding.domain = mesh();
  binding.domain_weights = solution().weights;
  auto& report = binding.report = report_;
  add_note(report.note, note());
  report.solve = solution().report;
  report.method =
      options_.coordinates ? name_of(*options_.coordinates) : name_of(report.solve.method);
  report.options = describe(options_);
  report.outside = static_cast<Index>(binding.outside.size());
  report.quality = measure_quality<Dim>(cage().points, placement.points, binding.weights);
  return binding;
}

template <int Dim>
std::string Rig<Dim>::note() const {
  auto text = placed_.masks.note();
  if (placed_.mirror) add_note(text, placed_.mirror->note());
  add_note(text, note_on_solid(options_.solid));
  return text;
}

template <int Dim>
Binding<Dim> Rig<Dim>::bind() {
  require_solution();
  const ThreadScope threads(options_.solver.threads);
  auto bound = binding();
  if (options_.max_influences == 0) return bound;
  const Stopwatch watch;
  if (!is_reduced_) {
    SparsifyOptions limits{options_.max_influences};
    const auto& observer = options_.observer;
    if (observer.poll) limits.progress = [&](double) { observer.poll(); };
    limits.start = few_;
    few_ = bound.reduced(limits, {}, options_.reduction).weights;
    is_reduced_ = true;
  }
  bound.weights = few_;
  bound.report.sparsify_seconds = watch.seconds();
  return bound;
}

template <int Dim>
void Rig<Dim>::drop_weights() {
  weights_ = {};
  is_reduced_ = false;
}

template class Rig<2>;
template class Rig<3>;

}  // namespace flbc
