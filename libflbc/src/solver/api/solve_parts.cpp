// SPDX-License-Identifier: BSD-3-Clause
#include "solver/api/solve_parts.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "base/instantiate.h"
#include "base/messages.h"
#include "flbc/boundary_values.h"
#include "flbc/domain_mesh.h"
#include "flbc/errors.h"

namespace flbc {
namespace {

// One part of the mesh with its cage.
template <int Dim>
struct Part {
  MeshPart<Dim> domain;
  Cage<Dim> cage{};
  std::vector<Index> control_points{};  // their indices in the whole cage
};

template <int Dim>
[[noreturn]] void refuse_split_facet(const Cage<Dim>& cage, Index facet) {
  throw InputError(std::string("the domain mesh has several parts, and ") +
                   (Dim == 2 ? "edge " : "triangle ") + std::to_string(facet) +
                   " of the cage, at " + format_point(cage.points.col(cage.facets(0, facet))) +
                   ", connects two of them");
}

// Assigns to each part the control points that are its vertices, and the facets between them.
template <int Dim>
void distribute(const Cage<Dim>& cage, const std::vector<Index>& part_of_control_point,
                std::vector<Part<Dim>>& parts) {
  std::vector<Index> number(cage.size());  // in the part
  for (Index i = 0; i < cage.size(); ++i) {
    auto& control_points = parts[part_of_control_point[i]].control_points;
    number[i] = static_cast<Index>(control_points.size());
    control_points.push_back(i);
  }
  std::vector<std::vector<Index>> facets(parts.size());
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    const Index p = part_of_control_point[cage.facets(0, f)];
    for (const Index i : cage.facets.col(f)) {
      if (part_of_control_point[i] != p) refuse_split_facet(cage, f);
    }
    facets[p].push_back(f);
  }
  for (std::size_t p = 0; p < parts.size(); ++p) {
    auto& [domain, part, control_points] = parts[p];
    if (control_points.empty()) {
      throw InputError("a part of the domain mesh has no control point: the one with " +
                       format_point(domain.mesh.points.col(0)));
    }
    part = {cage.points(Eigen::all, control_points), cage.facets(Eigen::all, facets[p])};
    for (Index& corner : part.facets.reshaped()) corner = number[corner];
  }
}

template <int Dim>
std::vector<Part<Dim>> take_apart(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh) {
  // Checks the whole cage, so that messages contain its indices.
  const auto boundary = boundary_values(cage, mesh, build_topology(mesh));
  std::vector<Part<Dim>> parts;
  std::vector<Index> part_of_vertex(mesh.num_vertices());
  for (auto& domain : mesh_parts(mesh)) {
    for (const Index v : domain.vertices) part_of_vertex[v] = static_cast<Index>(parts.size());
    parts.push_back({std::move(domain)});
  }
  std::vector<Index> part_of_control_point;
  for (const Index v : boundary.control_vertices) {
    part_of_control_point.push_back(part_of_vertex[v]);
  }
  distribute(cage, part_of_control_point, parts);
  std::sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
    return a.control_points.front() < b.control_points.front();
  });
  return parts;
}

Criterion common_criterion(const std::vector<SolveReport>& parts) {
  Criterion criterion = parts.front().criterion;
  for (const auto& part : parts) {
    if (part.criterion == Criterion::kNone) return Criterion::kNone;
    if (part.criterion == Criterion::kGap) criterion = Criterion::kGap;
  }
  return criterion;
}

// Set only if all parts have one.
Certificate sum_of_certificates(const std::vector<SolveReport>& parts) {
  Certificate sum;
  for (const auto& part : parts) {
    if (!(part.certificate.objective > 0)) return {};
    sum.objective += part.certificate.objective;
    sum.lower_bound += part.certificate.lower_bound;
  }
  sum.relative_gap = (sum.objective - sum.lower_bound) / sum.objective;
  return sum;
}

// Weighted by the number of pairs.
double mean_density(const std::vector<SolveReport>& parts) {
  double active = 0;
  double all = 0;
  for (const auto& part : parts) {
    const double pairs = static_cast<double>(part.control_points) * part.vertices;
    active += part.active_set.density * pairs;
    all += pairs;
  }
  return active / all;
}

void add(const SolveReport& part, SolveReport& whole) {
  whole.status = std::max(whole.status, part.status);  // later statuses are worse
  whole.control_points += part.control_points;
  whole.vertices += part.vertices;
  whole.cells += part.cells;
  whole.relative_primal_residual =
      std::max(whole.relative_primal_residual, part.relative_primal_residual);
  whole.relative_dual_residual =
      std::max(whole.relative_dual_residual, part.relative_dual_residual);
  whole.objective += part.objective;
  whole.mesh_error = std::max(whole.mesh_error, part.mesh_error);
  whole.distances.source = std::max(whole.distances.source, part.distances.source);
  whole.distances.vertices += part.distances.vertices;
  whole.distances.phi_error = std::max(whole.distances.phi_error, part.distances.phi_error);
  whole.active_set.growths = std::max(whole.active_set.growths, part.active_set.growths);
  whole.seconds.setup += part.seconds.setup;
  whole.seconds.solve += part.seconds.solve;
  whole.seconds.recover += part.seconds.recover;
  whole.seconds.certify += part.seconds.certify;
}

SolveReport join(std::vector<SolveReport> parts) {
  const auto& longest =
      *std::max_element(parts.begin(), parts.end(),
                        [](const auto& a, const auto& b) { return a.iterations < b.iterations; });
  SolveReport whole;
  whole.method = longest.method;
  whole.iterations = longest.iterations;
  whole.penalty = longest.penalty;
  whole.published_penalty = longest.published_penalty;
  whole.state_scalars_per_cell = longest.state_scalars_per_cell;
  whole.coarse_levels = longest.coarse_levels;
  for (const auto& part : parts) add(part, whole);
  whole.criterion = common_criterion(parts);
  whole.certificate = sum_of_certificates(parts);
  whole.active_set.density = mean_density(parts);
  whole.parts = std::move(parts);
  return whole;
}

// Weights of the whole mesh from those of its parts.
template <int Dim>
SparseWeights join(const std::vector<Part<Dim>>& parts, const std::vector<Solution>& solved,
                   Index num_control_points, Index num_vertices) {
  struct Place {
    std::size_t part;
    Index vertex;  // of the part
  };
  std::vector<Place> places(num_vertices);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto& vertices = parts[p].domain.vertices;
    for (std::size_t k = 0; k < vertices.size(); ++k)
      places[vertices[k]] = {p, static_cast<Index>(k)};
  }
  return SparseWeights::of(num_control_points, num_vertices, [&](Index v) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(num_control_points);
    const auto& [part, vertex] = places[v];
    solved[part].weights.visit(vertex, [&, part = part](Index i, double weight) {
      all[parts[part].control_points[i]] = weight;
    });
    return all;
  });
}

// Reports a part of every stage, from `before` to `before + share`, and the parts that follow.
// Keeps a reference.
Observer observer_of_part(const Observer& whole, double before, double share, int to_come) {
  auto part = whole;
  if (whole.progress) {
    part.progress = [&whole, to_come](Progress progress) {
      progress.finer_levels += to_come;
      return whole.progress(progress);
    };
  }
  if (whole.stage) {
    part.stage = [&whole, before, share](Stage stage, double done) {
      whole.stage(stage, before + share * done);
    };
  }
  return part;
}

}  // namespace

template <int Dim>
Solution solve_parts(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, const Observer& observer,
                     const SolvePart<Dim>& solve_part) {
  validate(mesh);
  if (count_parts(mesh) == 1) {
    std::vector<Index> all(cage.size());
    std::iota(all.begin(), all.end(), 0);
    return solve_part(cage, mesh, observer, all, false);
  }
  const auto parts = take_apart(cage, mesh);
  const auto unknowns = [](const Part<Dim>& part) {
    return static_cast<double>(part.cage.size()) * part.domain.mesh.num_vertices();
  };
  double all = 0, before = 0;
  bool stopped = false;
  for (const auto& part : parts) all += unknowns(part);

  std::vector<Solution> solved;
  std::vector<SolveReport> reports;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const double share = unknowns(parts[p]) / all;
    const auto to_come = static_cast<int>(parts.size() - p) - 1;
    solved.push_back(solve_part(parts[p].cage, parts[p].domain.mesh,
                                observer_of_part(observer, before, share, to_come),
                                parts[p].control_points, stopped));
    stopped = stopped || solved[p].report.status == SolveStatus::kStopped;
    reports.push_back(std::move(solved[p].report));
    before += share;
  }
  Solution whole;
  whole.report = join(std::move(reports));
  whole.weights = join(parts, solved, cage.size(), mesh.num_vertices());
  whole.report.quality = measure_quality(cage.points, mesh.points, whole.weights);
  return whole;
}

FLBC_INSTANTIATE_FUNCTION(solve_parts)

}  // namespace flbc
