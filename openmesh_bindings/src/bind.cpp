// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/bind.h"

#include <optional>
#include <vector>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "flbc/bounding_box.h"
#include "flbc/cell_locator.h"
#include "flbc/interpolate.h"
#include "flbc/solver.h"
#include "projection/nearest_point_in_hull.h"

namespace flbc::openmesh::internal {
namespace {

template <int Dim>
DomainMesh<Dim> make_interior(const BindInput<Dim>& input, const BindOptions& options) {
  if (input.domain) {
    auto domain = *input.domain;
    normalize_and_validate(domain);
    return domain;
  }
  MeshingOptions<Dim> meshing;
  meshing.vertices = options.vertices;
  if (options.vertices != BindOptions::kDefaultVertices) return input.mesher(input.cage, meshing);
  try {
    return input.mesher(input.cage, meshing);
  } catch (const OptionError&) {  // too few for this cage
    meshing.vertices = 0;
    return input.mesher(input.cage, meshing);
  }
}

template <int Dim>
CoarseMesher<Dim> coarse_mesher(const Mesher<Dim>& mesher) {
  if (!mesher) return {};
  // A mesher that fails on so few vertices must not keep the solve waiting.
  constexpr double kTimeLimit = 60;
  return [&mesher](const Cage<Dim>& cage, Index vertices) {
    MeshingOptions<Dim> meshing;
    meshing.vertices = vertices;
    meshing.time_limit = kTimeLimit;
    return mesher(cage, meshing);
  };
}

//! A place on the cage.
template <int Dim>
struct CagePlace {
  Index facet = -1;
  HullPoint<Dim> in_facet{};
};

template <int Dim>
CagePlace<Dim> nearest_on_cage(const Cage<Dim>& cage, const Vector<Dim>& point) {
  CagePlace<Dim> nearest;
  for (Index f = 0; f < static_cast<Index>(cage.facets.cols()); ++f) {
    PointList<Dim> corners(Dim, Dim);
    for (int k = 0; k < Dim; ++k) corners.col(k) = cage.points.col(cage.facets(k, f));
    const auto place = nearest_point_in_hull<Dim>(corners, point);
    if (nearest.facet < 0 || place.distance < nearest.in_facet.distance) nearest = {f, place};
  }
  return nearest;
}

template <int Dim>
std::vector<Location<Dim>> locate_or_miss(const DomainMesh<Dim>& domain,
                                          const PointList<Dim>& points) {
  const double tolerance = 1e-6 * bounding_box_diagonal<Dim>(domain.points);
  const CellLocator<Dim> locator(domain);
  const auto num_points = static_cast<Index>(points.cols());
  std::vector<Location<Dim>> places(static_cast<std::size_t>(num_points));
#pragma omp parallel for schedule(static)
  for (Index p = 0; p < num_points; ++p) places[p] = locator.locate(points.col(p), tolerance);
  return places;
}

//! The points as their weights are to place them: those outside are on the cage.
template <int Dim>
struct Evaluation {
  WeightMatrix weights;
  PointList<Dim> points;
  RowBlock<double> offsets;
  Index outside = 0;
};

// A point outside has the weights of the nearest point of the cage.
template <int Dim>
void follow_cage(const BindInput<Dim>& input, Index p, Evaluation<Dim>& evaluation) {
  const Vector<Dim> point = input.points.col(p);
  const auto place = nearest_on_cage<Dim>(input.cage, point);
  auto weights = evaluation.weights.col(p);
  weights.setZero();
  for (int k = 0; k < place.in_facet.size; ++k) {
    const Index corner = input.cage.facets(place.in_facet.support[k], place.facet);
    weights[corner] = place.in_facet.weights[k];
  }
  evaluation.points.col(p) = input.cage.points * weights;
  const auto offset = evaluation.offsets[static_cast<std::size_t>(p)];
  for (int d = 0; d < Dim; ++d) {
    offset[static_cast<std::size_t>(d)] = point[d] - evaluation.points(d, p);
  }
}

template <int Dim>
Evaluation<Dim> evaluate(const BindInput<Dim>& input, const DomainMesh<Dim>& domain,
                         const WeightMatrix& weights, OutsidePoints outside) {
  if (outside == OutsidePoints::kRefuse) {
    return {interpolate(domain, weights, locate_points(domain, input.points)), input.points, {}, 0};
  }
  auto places = locate_or_miss(domain, input.points);
  std::vector<Index> missed;
  for (std::size_t p = 0; p < places.size(); ++p) {
    if (places[p].cell >= 0) continue;
    missed.push_back(static_cast<Index>(p));
    places[p].cell = 0;
    places[p].coordinates.setZero();
  }
  Evaluation<Dim> evaluation{
      interpolate(domain, weights, places), input.points, {}, static_cast<Index>(missed.size())};
  if (missed.empty()) return evaluation;
  evaluation.offsets = RowBlock<double>(1, Dim);
  evaluation.offsets.resize(places.size());
  for (const Index p : missed) follow_cage(input, p, evaluation);
  return evaluation;
}

}  // namespace

template <int Dim>
Binding<Dim> bind_points(const BindInput<Dim>& input, const BindOptions& options) {
  if (input.points.cols() == 0) throw InputError("the model has no vertices");
  if (options.max_influences > 0) {
    validate<Dim>(SparsifyOptions{options.max_influences});
  } else if (options.max_influences < 0) {
    throw OptionError("max_influences must be positive, or 0 for all");
  }
  validate(options.solver);
  validate(input.cage);
  const ThreadScope threads(options.solver.threads);
  Binding<Dim> binding;
  auto& report = binding.report;
  Stopwatch watch;
  const auto domain = make_interior(input, options);
  report.mesh_seconds = watch.lap();
  const auto solution =
      flbc::solve(input.cage, domain, options.solver, coarse_mesher(input.mesher));
  report.solve = solution.report;
  report.solve_seconds = watch.lap();
  auto evaluation = evaluate(input, domain, solution.weights, options.outside);
  report.outside = evaluation.outside;
  report.evaluate_seconds = watch.lap();
  binding.weights = std::move(evaluation.weights);
  if (options.max_influences > 0) {
    binding.weights = reduce<Dim>(input.cage.points, evaluation.points, input.edges,
                                  binding.weights, options.max_influences, options.reduction, 0);
  }
  report.sparsify_seconds = watch.lap();
  report.quality = measure_quality<Dim>(input.cage.points, evaluation.points, binding.weights);
  binding.offsets = std::move(evaluation.offsets);
  return binding;
}

template Binding<2> bind_points(const BindInput<2>&, const BindOptions&);
template Binding<3> bind_points(const BindInput<3>&, const BindOptions&);

}  // namespace flbc::openmesh::internal
