// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/rig.h"

#include <string>
#include <utility>

#include "base/parallel.h"
#include "base/shape_checks.h"
#include "base/stopwatch.h"
#include "flbc/cage_facts.h"
#include "flbc/errors.h"
#include "flbc/mirror.h"

namespace flbc {
namespace {

template <int Dim>
void require_valid(const BindOptions& options) {
  if (options.max_influences > 0) {
    validate<Dim>(SparsifyOptions{options.max_influences});
  } else if (options.max_influences < 0) {
    throw OptionError("max_influences must be positive, or 0 for all");
  }
  validate(options.solver);
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

template <int Dim>
void require_inside(const Cage<Dim>& cage, const PointList<Dim>& points,
                    const BindOptions& options) {
  const ThreadScope threads(options.solver.threads);
  if (options.outside == OutsidePoints::kFail) place_points(cage, points);
}

// Images of points that are inside up to a tolerance may be outside by rounding.
OutsidePoints policy_of_images(const BindOptions& options) {
  return options.outside == OutsidePoints::kFail ? OutsidePoints::kNearest : options.outside;
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

}  // namespace

template <int Dim>
Rig<Dim>::Rig(Cage<Dim> cage, PointList<Dim> points, EdgeList edges, const BindOptions& options)
    : cage_(std::move(cage)),
      points_(std::move(points)),
      edges_(std::move(edges)),
      options_(options) {
  require_model<Dim>(points_, edges_);
  require_valid<Dim>(options_);
  validate(cage_);
}

template <int Dim>
Rig<Dim>::Rig(Cage<Dim> cage, PointList<Dim> points, EdgeList edges, const BindOptions& options,
              const Meshers<Dim>& meshers)
    : Rig(std::move(cage), std::move(points), std::move(edges), options) {
  require_points<Dim>(points_);
  require_inside(cage_, points_, options_);  // before a mesher starts
  const ThreadScope threads(options_.solver.threads);
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
    : Rig(std::move(cage), std::move(points), std::move(edges), options) {
  require_points<Dim>(points_);
  normalize_and_validate(domain);
  take({std::move(domain)});
}

template <int Dim>
Rig<Dim>::Rig(Cage<Dim> cage, MadeDomain<Dim> domain, PointList<Dim> points, EdgeList edges,
              const BindOptions& options)
    : Rig(std::move(cage), std::move(points), std::move(edges), options) {
  take(std::move(domain));
}

template <int Dim>
void Rig<Dim>::take(MadeDomain<Dim> domain) {
  mesh_ = std::move(domain.mesh);
  report_.mesher = std::move(domain.mesher);
  report_.note = std::move(domain.note);
  placed_ = place(cage_, mesh_, points_, options_);
}

template <int Dim>
typename Rig<Dim>::Placed Rig<Dim>::place(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                                          const PointList<Dim>& points,
                                          const BindOptions& options) {
  const ThreadScope threads(options.solver.threads);
  const Stopwatch watch;
  Placed placed;
  if (points.cols() > 0) {
    placed.placement = place_points(cage, mesh, points, options.outside);
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
      return place_points(cage, mesh, images, policy_of_images(options)).points;
    });
  }
  placed.masks = {};
  if (options.masks.empty()) return;
  const auto& [placement, mirror, unused, seconds] = placed;
  const auto masks = mirror ? mirror->symmetrized(options.masks) : options.masks;
  const auto images = mirror ? mirror->images() : std::vector<Index>{};
  placed.masks = place_masks(cage, mesh, placement, masks, images);
  if (mirror) mirror->keep_common(masks, placed.masks);
}

template <int Dim>
const Solution& Rig<Dim>::solve(const Budget& budget) {
  const auto& masks = placed_.masks;
  const Stopwatch watch;
  if (cage_parts(cage_).size() > 1) {
    solution_ = flbc::solve(cage_, mesh_, solver_options(options_, masks), options_.observer);
  } else if (solver_) {
    solver_->solve(budget, options_.observer);
  } else {
    auto solver = std::make_unique<Solver<Dim>>(cage_, mesh_, solver_options(options_, masks),
                                                options_.observer);
    solver->solve(budget, options_.observer);
    solver_ = std::move(solver);
  }
  weights_ = {};
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
  solution_ = std::move(solution);
  weights_ = {};
}

template <int Dim>
const Solution& Rig<Dim>::reshape(const PointList<Dim>& control_points, const Budget& budget) {
  if (cage_parts(cage_).size() > 1) {
    throw InputError(
        "a cage with several parts cannot be reshaped; bind the model to the new cage");
  }
  if (!solver_) solve();
  Placed placed;
  const auto masks_in = [&](const Cage<Dim>& cage, const DomainMesh<Dim>& mesh) {
    placed = place(cage, mesh, points_, options_);
    return solver_options(options_, placed.masks).masks;
  };
  solver_->reshape(control_points, budget, options_.observer, masks_in);
  placed_ = std::move(placed);
  weights_ = {};
  return solution();
}

template <int Dim>
void Rig<Dim>::set_model(PointList<Dim> points, EdgeList edges) {
  require_points<Dim>(points);
  require_model<Dim>(points, edges);
  auto placed = place(cage(), mesh(), points, options_);
  if (solver_ && !options_.masks.empty()) {
    solver_->set_options(solver_options(options_, placed.masks));
  }
  placed_ = std::move(placed);
  points_ = std::move(points);
  edges_ = std::move(edges);
  weights_ = {};
}

template <int Dim>
void Rig<Dim>::set_options(const BindOptions& options) {
  require_valid<Dim>(options);
  std::optional<Placed> changed;
  const bool has_other_mirror = options.mirror_axis != options_.mirror_axis;
  if (options.outside != options_.outside || (has_other_mirror && placed_.mirror)) {
    changed = place(cage(), mesh(), points_, options);
  } else if (has_other_mirror || options.masks != options_.masks) {
    changed = placed_;
    constrain(*changed, cage(), mesh(), points_, options);
  }
  if (solver_) {
    const auto& masks = changed ? changed->masks : placed_.masks;
    solver_->set_options(solver_options(options, masks));
  }
  options_ = options;
  if (!changed) return;
  placed_ = std::move(*changed);
  weights_ = {};
}

template <int Dim>
void Rig<Dim>::set_evaluation(std::function<SparseWeights(const Placement<Dim>&)> evaluate) {
  evaluate_ = std::move(evaluate);
  weights_ = {};
}

template <int Dim>
SparseWeights Rig<Dim>::evaluated(const Placement<Dim>& placement) const {
  if (evaluate_) return evaluate_(placement);
  return weights_at(cage(), mesh(), solution().weights, placement);
}

template <int Dim>
const SparseWeights& Rig<Dim>::weights_of_points() {
  if (weights_.num_points() > 0) return weights_;
  if (solution().weights.num_points() == 0) solve();
  const auto& [placement, mirror, masks, seconds] = placed_;
  if (points_.cols() == 0 && masks.masked == 0) return solution().weights;
  const ThreadScope threads(options_.solver.threads);
  const Stopwatch watch;
  auto weights = points_.cols() > 0 ? evaluated(placement) : solution().weights;
  if (masks.masked > 0) weights = enforce_masks(cage(), placement, weights, masks);
  if (mirror) {
    weights = mirror->symmetrized(weights, [&](const PointList<Dim>& points) {
      return evaluated(place_points(cage(), mesh(), points, policy_of_images(options_)));
    });
    if (masks.masked > 0) {
      weights = enforce_masks(cage(), placement, weights, mirror->of_single_points(masks));
    }
  }
  weights_ = std::move(weights);
  report_.evaluate_seconds = seconds + watch.seconds();
  return weights_;
}

template <int Dim>
SparseWeights Rig<Dim>::reduced(const SparsifyOptions& limits,
                                const std::vector<PointList<Dim>>& poses, Reduction reduction) {
  const ThreadScope threads(options_.solver.threads);
  const auto& weights = weights_of_points();
  const auto& [placement, mirror, masks, seconds] = placed_;
  const auto reduce_part = [&](const ModelPart<Dim>& part, Index most) {
    auto few = limits;
    few.max_influences = most;
    few.masks = part.masks;
    return reduce_influences<Dim>(cage().points, part.points, part.edges, part.weights, poses, few,
                                  reduction);
  };
  const auto reduce = [&, &mirror = mirror, &masks = masks](const PointList<Dim>& points,
                                                            const SparseWeights& given) {
    const ModelPart<Dim> model{points, points_.cols() > 0 ? edges_ : edges_of_cells(mesh()), given,
                               masks.of_points};
    const Index most = limits.max_influences;
    return mirror ? mirror->reduced(model, most, reduce_part) : reduce_part(model, most);
  };
  if (placement.outside.empty() || options_.outside != OutsidePoints::kExtend) {
    return reduce(placement.points, weights);
  }
  std::vector<bool> is_outside(weights.num_points(), false);
  for (const auto& vertex : placement.outside) is_outside[vertex.point] = true;
  // Of two lists of weights, the first at the points outside.
  const auto joined = [&](const SparseWeights& outside, const SparseWeights& inside) {
    return SparseWeights::of(
        weights.num_control_points(), weights.num_points(),
        [&](Index p) -> Eigen::VectorXd { return is_outside[p] ? outside.at(p) : inside.at(p); });
  };
  const auto nearest = place_points(cage(), mesh(), points_, OutsidePoints::kNearest);
  return joined(weights, reduce(nearest.points, joined(evaluated(nearest), weights)));
}

template <int Dim>
Binding<Dim> Rig<Dim>::bind() {
  const ThreadScope threads(options_.solver.threads);
  const auto& weights = weights_of_points();
  const auto& placement = placed_.placement;
  Binding<Dim> binding;
  for (const auto& vertex : placement.outside) binding.outside.push_back(vertex.point);
  binding.offsets = offsets_of(points_, placement);
  Stopwatch watch;
  if (options_.max_influences == 0) {
    binding.weights = weights;
  } else {
    SparsifyOptions limits{options_.max_influences};
    const auto& observer = options_.observer;
    if (observer.poll) limits.progress = [&](double) { observer.poll(); };
    binding.weights = reduced(limits, {}, options_.reduction);
  }
  auto& report = binding.report = report_;
  if (const auto note = placed_.masks.note(); !note.empty()) {
    report.note += (report.note.empty() ? "" : "; ") + note;
  }
  report.sparsify_seconds = watch.lap();
  report.solve = solution().report;
  report.outside = static_cast<Index>(binding.outside.size());
  report.quality = measure_quality<Dim>(cage().points, placement.points, binding.weights);
  return binding;
}

template class Rig<2>;
template class Rig<3>;

}  // namespace flbc
