// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/bind.h"

#include <utility>
#include <vector>

#include "base/messages.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "base/stopwatch.h"
#include "flbc/non_negative.h"
#include "flbc/solver.h"
#include "flbc/sparsify.h"

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
  } catch (const TooFewVertices&) {
    meshing.vertices = 0;
    return input.mesher(input.cage, meshing);
  }
}

//! The points that the weights must reproduce: for kNearest, those outside are moved onto the cage.
//! A constant offset is what the weights do not reproduce.
template <int Dim>
struct Evaluation {
  SparseWeights weights;
  PointList<Dim> points;
  RowBlock<double> offsets;
  std::vector<Index> outside;
};

template <int Dim>
Evaluation<Dim> evaluate(const BindInput<Dim>& input, const DomainMesh<Dim>& domain,
                         const SparseWeights& weights, OutsidePoints outside) {
  auto placement = place_points(input.cage, domain, input.points, outside);
  Evaluation<Dim> evaluation{
      weights_at(input.cage, domain, weights, placement), std::move(placement.points), {}, {}};
  for (const auto& vertex : placement.outside) evaluation.outside.push_back(vertex.point);
  if (placement.outside.empty() || outside == OutsidePoints::kExtend) return evaluation;
  evaluation.offsets = RowBlock<double>(1, Dim);
  evaluation.offsets.resize(placement.places.size());
  for (const auto& beside : placement.outside) {
    const auto offset = evaluation.offsets[static_cast<std::size_t>(beside.point)];
    const Vector<Dim> constant = outside == OutsidePoints::kKeep
                                     ? Vector<Dim>(input.points.col(beside.point))
                                     : beside.offset;
    for (int d = 0; d < Dim; ++d) offset[static_cast<std::size_t>(d)] = constant[d];
  }
  return evaluation;
}

//! Points outside keep the weights of an extension: negative weights cannot be reduced.
template <int Dim>
SparseWeights reduce_inside(const BindInput<Dim>& input, const DomainMesh<Dim>& domain,
                            const SparseWeights& weights, const Evaluation<Dim>& evaluation,
                            const BindOptions& options) {
  SparsifyOptions few{options.max_influences};
  if (options.observer.poll) few.progress = [&](double) { options.observer.poll(); };
  const auto reduced = [&](const Evaluation<Dim>& all) {
    return reduce<Dim>(input.cage.points, all.points, input.edges, all.weights, options.reduction,
                       few);
  };
  if (options.outside != OutsidePoints::kExtend || evaluation.outside.empty())
    return reduced(evaluation);
  const auto inside = reduced(evaluate(input, domain, weights, OutsidePoints::kNearest));
  const auto& outside = evaluation.outside;
  return SparseWeights::of(
      inside.num_control_points(), inside.num_points(), [&](Index point) -> Eigen::VectorXd {
        const bool is_outside = std::binary_search(outside.begin(), outside.end(), point);
        return is_outside ? evaluation.weights.at(point) : inside.at(point);
      });
}

}  // namespace

template <int Dim>
Binding<Dim> bind_points(const BindInput<Dim>& input, const BindOptions& options) {
  if (input.points.cols() == 0) throw InputError("the model has no vertices");
  check_finite<Dim>(input.points);
  if (options.max_influences > 0) {
    validate<Dim>(SparsifyOptions{options.max_influences});
  } else if (options.max_influences < 0) {
    throw OptionError("max_influences must be positive, or 0 for all");
  }
  validate(options.solver);
  validate(input.cage);
  const ThreadScope threads(options.solver.threads);
  // Before the mesher and the solver start.
  if (options.outside == OutsidePoints::kFail) place_points(input.cage, input.points);
  Binding<Dim> binding;
  auto& report = binding.report;
  Stopwatch watch;
  const auto domain = make_interior(input, options);
  report.mesh_seconds = watch.lap();
  const auto solution = flbc::solve(input.cage, domain, options.solver, options.observer);
  report.solve = solution.report;
  report.solve_seconds = watch.lap();
  auto evaluation = evaluate(input, domain, solution.weights, options.outside);
  report.outside = static_cast<Index>(evaluation.outside.size());
  report.evaluate_seconds = watch.lap();
  binding.weights = options.max_influences > 0
                        ? reduce_inside(input, domain, solution.weights, evaluation, options)
                        : std::move(evaluation.weights);
  report.sparsify_seconds = watch.lap();
  report.quality = measure_quality<Dim>(input.cage.points, evaluation.points, binding.weights);
  binding.offsets = std::move(evaluation.offsets);
  return binding;
}

namespace {

template <int Dim>
Eigen::VectorXd reproducing_in(const PointList<Dim>& cage, const PointList<Dim>& point,
                               const WeightMatrix& given, std::size_t most) {
  auto weights = project_non_negative(cage, point, given);
  if (most > 0) weights = flbc::sparsify<Dim>(cage, point, weights, {static_cast<Index>(most)});
  return weights.at(0);
}

}  // namespace

Eigen::VectorXd reproducing(const Eigen::MatrixXd& cage, const Eigen::VectorXd& point, int vertex,
                            const Eigen::VectorXd& weights, std::size_t most) {
  try {
    return cage.rows() == 2 ? reproducing_in<2>(cage, point, weights, most)
                            : reproducing_in<3>(cage, point, weights, most);
  } catch (const InputError&) {
    throw InputError("vertex " + std::to_string(vertex) + " at " + format_point(point) +
                     " is outside the convex hull of the cage; move it inside");
  }
}

void refuse_without_neighbors(int vertex) {
  throw InputError("vertex " + std::to_string(vertex) +
                   " is not connected with vertices that have weights; connect it, or bind the "
                   "model again");
}

void refuse_moved(int vertex) {
  throw InputError("vertex " + std::to_string(vertex) +
                   " is not where bind() found it, so the model is not at rest; call "
                   "restore_rest(), or bind the model again if its rest shape has changed");
}

template <int Dim>
void refuse_doubled_vertices(const Cage<Dim>& cage) {
  for (const auto& defect : find_defects(cage, 1)) {
    if (defect.kind != DefectKind::kCoincident) continue;
    throw InputError(defect.message +
                     "; OpenMesh doubles vertices where more than two faces meet at an edge when "
                     "it reads a file, so look for such edges in the file of the cage");
  }
}

template void refuse_doubled_vertices(const Cage<2>&);
template void refuse_doubled_vertices(const Cage<3>&);
template Binding<2> bind_points(const BindInput<2>&, const BindOptions&);
template Binding<3> bind_points(const BindInput<3>&, const BindOptions&);

}  // namespace flbc::openmesh::internal
