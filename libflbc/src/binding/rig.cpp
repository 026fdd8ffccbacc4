// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/rig.h"

#include <algorithm>
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
void require_model(const PointList<Dim>& points, const EdgeList& edges) {
  if (points.cols() == 0) throw InputError("the model has no vertices");
  check_finite<Dim>(points);
  validate(edges, points.cols());
}

template <int Dim>
void require_inside(const Cage<Dim>& cage, const PointList<Dim>& points,
                    const BindOptions& options) {
  const ThreadScope threads(options.solver.threads);
  if (options.outside == OutsidePoints::kFail) place_points(cage, points);
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

// With the images of masks if weights are mirrored.
template <int Dim>
std::vector<Mask> masks_of(const Cage<Dim>& cage, const PointList<Dim>& points,
                           const BindOptions& options) {
  if (options.mirror_axis < 0) return options.masks;
  return MirroredModel<Dim>(cage, options.mirror_axis, points).symmetrized(options.masks);
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
  require_inside(cage_, points_, options_);  // before a mesher starts
}

template <int Dim>
Rig<Dim>::Rig(Cage<Dim> cage, PointList<Dim> points, EdgeList edges, const BindOptions& options,
              const Meshers<Dim>& meshers)
    : Rig(std::move(cage), std::move(points), std::move(edges), options) {
  const ThreadScope threads(options_.solver.threads);
  const Stopwatch watch;
  MeshingOptions<Dim> meshing;
  meshing.vertices = options_.vertices;
  meshing.poll = options_.observer.poll;
  auto made = make_domain(cage_, meshing, meshers);
  mesh_ = std::move(made.mesh);
  report_.mesher = std::move(made.mesher);
  report_.note = std::move(made.note);
  report_.mesh_seconds = watch.seconds();
  if (!options_.masks.empty()) masks_ = placed_masks(points_, placed(), options_);
}

template <int Dim>
Rig<Dim>::Rig(Cage<Dim> cage, DomainMesh<Dim> domain, PointList<Dim> points, EdgeList edges,
              const BindOptions& options)
    : Rig(std::move(cage), std::move(points), std::move(edges), options) {
  mesh_ = std::move(domain);
  normalize_and_validate(mesh_);
  if (!options_.masks.empty()) masks_ = placed_masks(points_, placed(), options_);
}

template <int Dim>
const Placement<Dim>& Rig<Dim>::placed() {
  if (placement_.points.cols() != points_.cols()) {
    const ThreadScope threads(options_.solver.threads);
    placement_ = place_points(cage(), mesh(), points_, options_.outside);
  }
  return placement_;
}

template <int Dim>
PlacedMasks Rig<Dim>::placed_masks(const PointList<Dim>& points, const Placement<Dim>& placement,
                                   const BindOptions& options) const {
  return place_masks(cage(), mesh(), placement, masks_of(cage(), points, options));
}

template <int Dim>
const Solution& Rig<Dim>::solve(const Budget& budget) {
  const Stopwatch watch;
  if (cage_parts(cage_).size() > 1) {
    solution_ = flbc::solve(cage_, mesh_, solver_options(options_, masks_), options_.observer);
  } else if (solver_) {
    solver_->solve(budget, options_.observer);
  } else {
    auto solver = std::make_unique<Solver<Dim>>(cage_, mesh_, solver_options(options_, masks_),
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
  const Cage<Dim> moved{control_points, cage_.facets};
  validate(moved);
  require_inside(moved, points_, options_);
  if (!solver_) solve();
  solver_->move(control_points, budget, options_.observer);
  placement_ = {};
  weights_ = {};
  return solution();
}

template <int Dim>
void Rig<Dim>::set_model(PointList<Dim> points, EdgeList edges) {
  require_model<Dim>(points, edges);
  require_inside(cage(), points, options_);
  Placement<Dim> placement;
  if (!options_.masks.empty()) {
    const ThreadScope threads(options_.solver.threads);
    placement = place_points(cage(), mesh(), points, options_.outside);
    auto masks = placed_masks(points, placement, options_);
    if (solver_) solver_->set_options(solver_options(options_, masks));
    masks_ = std::move(masks);
  }
  placement_ = std::move(placement);
  points_ = std::move(points);
  edges_ = std::move(edges);
  weights_ = {};
}

template <int Dim>
void Rig<Dim>::set_options(const BindOptions& options) {
  require_valid<Dim>(options);
  const bool moves = options.outside != options_.outside;
  if (moves) require_inside(cage(), points_, options);
  Placement<Dim> placement;
  PlacedMasks masks;
  if (!options.masks.empty()) {
    const ThreadScope threads(options.solver.threads);
    if (moves) placement = place_points(cage(), mesh(), points_, options.outside);
    masks = placed_masks(points_, moves ? placement : placed(), options);
  }
  if (solver_) solver_->set_options(solver_options(options, masks));
  if (moves) placement_ = std::move(placement);
  if (moves || options.masks != options_.masks || options.mirror_axis != options_.mirror_axis) {
    weights_ = {};
  }
  masks_ = std::move(masks);
  options_ = options;
}

template <int Dim>
const SparseWeights& Rig<Dim>::weights_of_points() {
  if (weights_.num_points() == points_.cols()) return weights_;
  if (solution().weights.num_points() == 0) solve();
  const ThreadScope threads(options_.solver.threads);
  const Stopwatch watch;
  const auto weights_in = [&](const Placement<Dim>& placement) {
    return weights_at(cage(), mesh(), solution().weights, placement);
  };
  const bool has_moved = placement_.points.cols() != points_.cols();  // the cage
  auto weights = weights_in(placed());
  if (has_moved && !options_.masks.empty()) masks_ = placed_masks(points_, placement_, options_);
  weights_ = enforce_locality<Dim>(
      cage(), placement_, std::move(weights), masks_, options_.mirror_axis,
      [&](const PointList<Dim>& points) {
        return weights_in(place_points(cage(), mesh(), points, options_.outside));
      });
  report_.evaluate_seconds = watch.seconds();
  return weights_;
}

template <int Dim>
SparseWeights Rig<Dim>::reduced(const Placement<Dim>& placement,
                                const SparseWeights& weights) const {
  const auto reduce = [&](const ModelPart<Dim>& part, Index most) {
    SparsifyOptions few{most};
    few.masks = part.masks;
    const auto& observer = options_.observer;
    if (observer.poll) few.progress = [&](double) { observer.poll(); };
    return reduce_influences<Dim>(cage().points, part.points, part.edges, part.weights, {}, few,
                                  options_.reduction);
  };
  const ModelPart<Dim> model{placement.points, edges_, weights, masks_.of_points};
  const Index most = options_.max_influences;
  if (options_.mirror_axis < 0) return reduce(model, most);
  return MirroredModel<Dim>(cage(), options_.mirror_axis, placement.points)
      .reduced(model, most, reduce);
}

// Points outside keep the weights of an extension: negative weights cannot be reduced.
template <int Dim>
SparseWeights Rig<Dim>::reduced_inside(const std::vector<Index>& outside) {
  const auto nearest = place_points(cage(), mesh(), points_, OutsidePoints::kNearest);
  const auto inside = reduced(nearest, weights_at(cage(), mesh(), solution().weights, nearest));
  return SparseWeights::of(
      inside.num_control_points(), inside.num_points(), [&](Index point) -> Eigen::VectorXd {
        const bool is_outside = std::binary_search(outside.begin(), outside.end(), point);
        return is_outside ? weights_.at(point) : inside.at(point);
      });
}

template <int Dim>
Binding<Dim> Rig<Dim>::bind() {
  const ThreadScope threads(options_.solver.threads);
  weights_of_points();
  Binding<Dim> binding;
  for (const auto& vertex : placement_.outside) binding.outside.push_back(vertex.point);
  binding.offsets = offsets_of(points_, placement_);
  Stopwatch watch;
  const bool extends = !binding.outside.empty() && options_.outside == OutsidePoints::kExtend;
  if (options_.max_influences == 0) {
    binding.weights = weights_;
  } else {
    binding.weights = extends ? reduced_inside(binding.outside) : reduced(placement_, weights_);
  }
  auto& report = binding.report = report_;
  if (const auto note = masks_.note(); !note.empty()) {
    report.note += (report.note.empty() ? "" : "; ") + note;
  }
  report.sparsify_seconds = watch.lap();
  report.solve = solution().report;
  report.outside = static_cast<Index>(binding.outside.size());
  report.quality = measure_quality<Dim>(cage().points, placement_.points, binding.weights);
  return binding;
}

template class Rig<2>;
template class Rig<3>;

}  // namespace flbc
