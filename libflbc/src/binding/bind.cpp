// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/bind.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "base/shape_checks.h"
#include "base/stopwatch.h"
#include "flbc/deform.h"
#include "flbc/errors.h"

namespace flbc {
namespace {

// Keeps references.
template <int Dim>
struct Model {
  const Cage<Dim>& cage;
  const PointList<Dim>& points;
  const EdgeList& edges;
};

// Weights of points, and the points that they reproduce: for kNearest, those outside are moved onto
// the cage.
template <int Dim>
struct Evaluation {
  Placement<Dim> placement;
  SparseWeights weights;
};

template <int Dim>
Evaluation<Dim> evaluate(const Model<Dim>& model, const DomainMesh<Dim>& domain,
                         const SparseWeights& weights, OutsidePoints outside) {
  auto placement = place_points(model.cage, domain, model.points, outside);
  auto at_points = weights_at(model.cage, domain, weights, placement);
  return {std::move(placement), std::move(at_points)};
}

// What the weights do not reproduce.
template <int Dim>
PointList<Dim> offsets_of(const Model<Dim>& model, const Placement<Dim>& placement) {
  if (placement.outside.empty() || placement.policy == OutsidePoints::kExtend) return {};
  PointList<Dim> offsets = PointList<Dim>::Zero(Dim, model.points.cols());
  for (const auto& [point, facet, coordinates, offset] : placement.outside) {
    offsets.col(point) =
        placement.policy == OutsidePoints::kKeep ? Vector<Dim>(model.points.col(point)) : offset;
  }
  return offsets;
}

template <int Dim>
SparseWeights reduced(const Model<Dim>& model, const Evaluation<Dim>& evaluation,
                      const BindOptions& options) {
  SparsifyOptions few{options.max_influences};
  if (options.observer.poll) few.progress = [&](double) { options.observer.poll(); };
  const auto& [cage, points, edges] = model;
  const auto& places = evaluation.placement.points;
  return reduce_influences<Dim>(cage.points, places, edges, evaluation.weights, {}, few,
                                options.reduction);
}

// Points outside keep the weights of an extension: negative weights cannot be reduced.
template <int Dim>
SparseWeights reduced_inside(const Model<Dim>& model, const DomainMesh<Dim>& domain,
                             const SparseWeights& weights, const Evaluation<Dim>& extended,
                             const std::vector<Index>& outside, const BindOptions& options) {
  const auto inside =
      reduced(model, evaluate(model, domain, weights, OutsidePoints::kNearest), options);
  return SparseWeights::of(
      inside.num_control_points(), inside.num_points(), [&](Index point) -> Eigen::VectorXd {
        const bool is_outside = std::binary_search(outside.begin(), outside.end(), point);
        return is_outside ? extended.weights.at(point) : inside.at(point);
      });
}

template <int Dim>
void require_valid(const Model<Dim>& model, const BindOptions& options) {
  if (model.points.cols() == 0) throw InputError("the model has no vertices");
  check_finite<Dim>(model.points);
  if (options.max_influences > 0) {
    validate<Dim>(SparsifyOptions{options.max_influences});
  } else if (options.max_influences < 0) {
    throw OptionError("max_influences must be positive, or 0 for all");
  }
  validate(options.solver);
  validate(model.cage);
  validate(model.edges, model.points.cols());
  // Before the mesher and the solver start.
  if (options.outside == OutsidePoints::kFail) place_points(model.cage, model.points);
}

// \param make_domain  () -> DomainMesh; may note in the report
template <int Dim, class MakeDomain>
Binding<Dim> bind_with(const Model<Dim>& model, const BindOptions& options,
                       const MakeDomain& make_domain) {
  const ThreadScope threads(options.solver.threads);
  require_valid(model, options);
  Binding<Dim> binding;
  auto& report = binding.report;
  Stopwatch watch;
  const DomainMesh<Dim> domain = make_domain(report);
  report.mesh_seconds = watch.lap();
  const auto solution = solve(model.cage, domain, options.solver, options.observer);
  report.solve = solution.report;
  report.solve_seconds = watch.lap();
  auto evaluation = evaluate(model, domain, solution.weights, options.outside);
  const auto& placement = evaluation.placement;
  for (const auto& vertex : placement.outside) binding.outside.push_back(vertex.point);
  report.outside = static_cast<Index>(binding.outside.size());
  binding.offsets = offsets_of(model, placement);
  report.evaluate_seconds = watch.lap();
  const bool extends = !binding.outside.empty() && options.outside == OutsidePoints::kExtend;
  if (options.max_influences == 0) {
    binding.weights = std::move(evaluation.weights);
  } else {
    binding.weights = extends ? reduced_inside(model, domain, solution.weights, evaluation,
                                               binding.outside, options)
                              : reduced(model, evaluation, options);
  }
  report.sparsify_seconds = watch.lap();
  report.quality = measure_quality<Dim>(model.cage.points, placement.points, binding.weights);
  return binding;
}

}  // namespace

template <int Dim>
PointList<Dim> Binding<Dim>::deform(const PointList<Dim>& control_points) const {
  PointList<Dim> moved = flbc::deform<Dim>(weights, control_points);
  if (offsets.cols() > 0) moved += offsets;
  return moved;
}

template <int Dim>
Binding<Dim> bind(const Cage<Dim>& cage, const PointList<Dim>& points, const EdgeList& edges,
                  const BindOptions& options, const Meshers<Dim>& meshers) {
  return bind_with<Dim>({cage, points, edges}, options, [&](BindReport& report) {
    MeshingOptions<Dim> meshing;
    meshing.vertices = options.vertices;
    auto made = make_domain(cage, meshing, meshers, options.observer.poll);
    report.mesher = std::move(made.mesher);
    report.note = std::move(made.note);
    return std::move(made.mesh);
  });
}

template <int Dim>
Binding<Dim> bind(const Cage<Dim>& cage, const DomainMesh<Dim>& domain,
                  const PointList<Dim>& points, const EdgeList& edges, const BindOptions& options) {
  return bind_with<Dim>({cage, points, edges}, options, [&](BindReport&) {
    auto mesh = domain;
    normalize_and_validate(mesh);
    return mesh;
  });
}

#define FLBC_INSTANTIATE(Dim)                                                                 \
  template struct Binding<Dim>;                                                               \
  template Binding<Dim> bind(const Cage<Dim>&, const PointList<Dim>&, const EdgeList&,        \
                             const BindOptions&, const Meshers<Dim>&);                        \
  template Binding<Dim> bind(const Cage<Dim>&, const DomainMesh<Dim>&, const PointList<Dim>&, \
                             const EdgeList&, const BindOptions&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
