// SPDX-License-Identifier: BSD-3-Clause
// Public functions of the core with damaged arguments.
#include "flbc/binding.h"
#include "flbc/boundary_values.h"
#include "flbc/cage_facts.h"
#include "flbc/cell_locator.h"
#include "flbc/certificate.h"
#include "flbc/check.h"
#include "flbc/coordinates.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "flbc/evaluator.h"
#include "flbc/gradients.h"
#include "flbc/green.h"
#include "flbc/harmonic.h"
#include "flbc/meshing.h"
#include "flbc/non_negative.h"
#include "flbc/options.h"
#include "flbc/pointwise.h"
#include "flbc/poses.h"
#include "flbc/quality.h"
#include "flbc/solver.h"
#include "flbc/sparsify.h"
#include "flbc/sparsify_error.h"
#include "fuzz/mutations.h"
#include "support/sample_meshes.h"

namespace flbc::fuzz {
namespace {

using testing::make_sample;
using testing::Shape;

// A cage with its mesh, weights, and a problem, all valid.
template <int Dim>
struct Valid {
  testing::Sample<Dim> sample = make_sample<Dim>(Shape::kCorner, 2, 0.1);
  LbcProblem<Dim> problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, 0);
  SparseWeights weights = solve(sample.cage, sample.mesh).weights;
};

template <int Dim>
const Valid<Dim>& valid() {
  static const Valid<Dim> instance;
  return instance;
}

template <int Dim>
Cage<Dim> some_cage(Mutator& mutator) {
  auto cage = valid<Dim>().sample.cage;
  mutator.damage(cage.points);
  mutator.damage(cage.facets);
  return cage;
}

template <int Dim>
DomainMesh<Dim> some_mesh(Mutator& mutator) {
  auto mesh = valid<Dim>().sample.mesh;
  mutator.damage(mesh.points);
  mutator.damage(mesh.cells);
  return mesh;
}

template <int Dim>
MeshTopology<Dim> some_topology(Mutator& mutator) {
  auto topology = valid<Dim>().problem.topology;
  mutator.damage(topology.facets);
  mutator.damage(topology.sides);
  mutator.damage(topology.cell_facets);
  return topology;
}

template <int Dim>
SparseWeights some_weights(Mutator& mutator) {
  WeightMatrix weights = valid<Dim>().weights.dense();
  mutator.damage(weights);
  return weights;
}

template <int Dim>
WeightFunctions some_phi(Mutator& mutator) {
  Eigen::MatrixXd phi = valid<Dim>().problem.phi.dense();
  mutator.damage(phi);
  return WeightFunctions(phi);
}

// Vertices of the mesh, of which some moved out of the cage.
template <int Dim>
PointList<Dim> some_points(Mutator& mutator) {
  PointList<Dim> points = valid<Dim>().sample.mesh.points;
  if (mutator.below(2) == 0) points.col(mutator.below(points.cols())) *= 1.5;
  mutator.damage(points);
  return points;
}

template <int Dim>
PointList<Dim> some_pose(Mutator& mutator) {
  PointList<Dim> pose = valid<Dim>().sample.cage.points;
  pose.col(mutator.below(pose.cols()))[0] += 0.01;
  mutator.damage(pose);
  return pose;
}

template <int Dim>
std::vector<PointList<Dim>> some_poses(Mutator& mutator) {
  std::vector<PointList<Dim>> poses;
  for (Index count = mutator.below(3); count > 0; --count) {
    poses.push_back(some_pose<Dim>(mutator));
  }
  return poses;
}

EdgeList some_edges(Mutator& mutator, const EdgeList& all) {
  using Ends = Eigen::Matrix<Index, 2, Eigen::Dynamic>;
  const auto count = static_cast<Eigen::Index>(all.ends.size());
  Ends ends(2, count);
  for (Eigen::Index k = 0; k < count; ++k) ends.col(k) << all.ends[k][0], all.ends[k][1];
  Eigen::RowVectorXd lengths = Eigen::Map<const Eigen::RowVectorXd>(
      all.weights.data(), static_cast<Eigen::Index>(all.weights.size()));
  mutator.damage(ends);
  mutator.damage(lengths);
  EdgeList edges;
  for (const auto& column : ends.colwise()) edges.ends.push_back({column[0], column[1]});
  edges.weights.assign(lengths.begin(), lengths.end());
  return edges;
}

OutsidePoints some_policy(Mutator& mutator) {
  return mutator.one_of({OutsidePoints::kFail, OutsidePoints::kNearest, OutsidePoints::kExtend});
}

DistanceScheme some_scheme(Mutator& mutator) {
  return mutator.one_of({DistanceScheme::kSquare, DistanceScheme::kLinear,
                         DistanceScheme::kSquareRoot, DistanceScheme::kConstant});
}

Coordinates some_coordinates(Mutator& mutator) {
  return mutator.one_of({Coordinates::kHarmonic, Coordinates::kMeanValue, Coordinates::kMaxEntropy,
                         Coordinates::kMaxLikelihood, Coordinates::kBlended,
                         Coordinates::kBiharmonic, Coordinates::kGreen});
}

SolverOptions some_options(Mutator& mutator) {
  SolverOptions options;
  options.method =
      mutator.one_of({Method::kWeights, Method::kGradient, Method::kPaper, Method::kLbc2014});
  options.max_iterations = 12;
  options.certify = mutator.below(4) == 0;
  options.phi = some_scheme(mutator);
  if (mutator.below(4) == 0) options.active_set = ActiveSet::kOn;
  if (mutator.below(4) == 0) options.precision = Precision::kDouble;
  return options;
}

// --------------------------------------------------------------------------------------- problems

template <int Dim>
SolverOptions some_options_for(const LbcProblem<Dim>& problem, Mutator& mutator) {
  auto options = some_options(mutator);
  options.smoothness = problem.smoothness;
  return options;
}

template <int Dim>
void solve_once(Mutator& mutator) {
  solve(some_cage<Dim>(mutator), some_mesh<Dim>(mutator), some_options(mutator));
}

template <int Dim>
void compute_other(Mutator& mutator) {
  compute_coordinates(some_cage<Dim>(mutator), some_mesh<Dim>(mutator), some_coordinates(mutator));
}

template <int Dim>
void solve_with_topology(Mutator& mutator) {
  const auto topology = some_topology<Dim>(mutator);
  const auto options = some_options(mutator);
  solve<Dim>(some_cage<Dim>(mutator), some_mesh<Dim>(mutator), topology, options, {});
}

template <int Dim>
void solve_problem(Mutator& mutator) {
  auto problem = valid<Dim>().problem;
  problem.phi = some_phi<Dim>(mutator);
  solve(problem, some_options_for(problem, mutator));
}

template <int Dim>
void judge_problem(Mutator& mutator) {
  auto problem = valid<Dim>().problem;
  problem.phi = some_phi<Dim>(mutator);
  const auto weights = some_weights<Dim>(mutator);
  const std::vector<double> flux(static_cast<std::size_t>(problem.mesh.num_cells()) * Dim *
                                 static_cast<std::size_t>(problem.num_control_points()));
  const CellFieldView<double, Dim> view{flux.data(),
                                        static_cast<std::size_t>(problem.num_control_points()),
                                        problem.num_control_points()};
  mutator.call_one({
      [&] { certify<double, Dim>(problem, view, weights.dense()); },
      [&] { lower_bound<double, Dim>(problem, view, weights); },
      [&] { objective(problem, weights); },
      [&] { gradient_jump(problem, weights); },
      [&] { squared_error(problem, weights, some_weights<Dim>(mutator)); },
  });
}

template <int Dim>
void set_up(Mutator& mutator) {
  const auto cage = some_cage<Dim>(mutator);
  const auto mesh = some_mesh<Dim>(mutator);
  const auto problem = mutator.below(2) == 0 ? make_problem(cage, mesh, some_scheme(mutator), 0.003)
                                             : make_problem(cage, mesh, some_topology<Dim>(mutator),
                                                            some_scheme(mutator), 0.003);
  mutator.call_one({
      [&] { harmonic_coordinates(problem); },
      [&] { bounded_biharmonic_weights(problem); },
      [&] { solve(problem, some_options_for(problem, mutator)); },
  });
}

template <int Dim>
void solve_and_move(Mutator& mutator) {
  const auto& [cage, mesh, name] = valid<Dim>().sample;
  const bool is_valid = mutator.below(2) == 0;
  auto options = some_options(mutator);
  options.method = mutator.one_of({Method::kWeights, Method::kGradient});
  options.certify = false;
  Solver<Dim> solver(is_valid ? cage : some_cage<Dim>(mutator),
                     is_valid ? mesh : some_mesh<Dim>(mutator), options);
  for (int times = 0; times < 3; ++times) {
    try {
      solver.reshape(some_pose<Dim>(mutator), {3, 0});
    } catch (const Error&) {
      // A refused pose leaves the object as it was.
      solver.solve({3, 0});
    }
  }
}

// ------------------------------------------------------------------------------- cages and meshes

template <int Dim>
void look_at_cage(Mutator& mutator) {
  const auto cage = some_cage<Dim>(mutator);
  mutator.call_one({
      [&] { find_defects(cage); },
      [&] { validate(cage); },
      [&] { measure_cage(cage); },
      [&] { thinnest_place(cage); },
      [&] { points_outside(cage, some_points<Dim>(mutator)); },
      [&] { cage_parts(cage); },
      [&] { embeddable_points(cage, some_points<Dim>(mutator)); },
  });
}

template <int Dim>
void look_at_mesh(Mutator& mutator) {
  auto mesh = some_mesh<Dim>(mutator);
  const auto cage = some_cage<Dim>(mutator);
  mutator.call_one({
      [&] { normalize_and_validate(mesh); },
      [&] { count_parts(mesh); },
      [&] { join_parts(mesh_parts(mesh)); },
      [&] { require_connected(mesh); },
      [&] { edges_of_cells(mesh); },
      [&] { locate_points(mesh, some_points<Dim>(mutator)); },
      [&] { published_penalty(cage, mesh, Method::kPaper, 100); },
      [&] {
        auto parts = mesh_parts(valid<Dim>().sample.mesh);
        mutator.damage(parts.front().vertices);
        join_parts(parts);
      },
      [&] { build_topology(mesh); },
  });
}

template <int Dim>
void find_boundary(Mutator& mutator) {
  auto mesh = some_mesh<Dim>(mutator);
  const auto cage = some_cage<Dim>(mutator);
  const auto topology =
      mutator.below(2) == 0 ? some_topology<Dim>(mutator) : valid<Dim>().problem.topology;
  mutator.call_one({
      [&] { boundary_values(cage, mesh, topology); },
      [&] { snap_to_cage(cage, topology, 1e-3, mesh); },
      [&] { boundary_vertices(topology, mesh.num_vertices()); },
      [&] { validate(mesh, topology); },
      [&] {
        auto sources = valid<Dim>().problem.boundary.control_vertices;
        mutator.damage(sources);
        const auto distances = geodesic_distances(mesh, topology, sources);
        WeightFunctions(some_scheme(mutator), distances, mesh, cage.size());
      },
  });
}

// ----------------------------------------------------------------------------------------- points

template <int Dim>
void place(Mutator& mutator) {
  const auto cage = some_cage<Dim>(mutator);
  const auto mesh = some_mesh<Dim>(mutator);
  const auto points = some_points<Dim>(mutator);
  const auto policy = some_policy(mutator);
  if (mutator.below(4) == 0) {
    const auto placement = place_points(cage, points, policy);
    weights_at(cage, some_weights<Dim>(mutator), placement);
    weights_at(cage, mesh, some_weights<Dim>(mutator), placement);
    return;
  }
  auto placement = place_points(cage, mesh, points, policy);
  if (mutator.below(4) == 0 && !placement.places.empty()) placement.places.pop_back();
  const auto weights = some_weights<Dim>(mutator);
  weights_at(cage, mesh, weights, placement);
  gradients_at(mesh, weights, placement.places);
  const auto places = places_in_mesh(cage, mesh, placement);
  interpolate(mesh, weights, places);
  jacobians(gradients_at(mesh, weights, places), some_pose<Dim>(mutator));
}

template <int Dim>
void place_near(Mutator& mutator) {
  const auto cage = some_cage<Dim>(mutator);
  const auto points = some_points<Dim>(mutator);
  std::vector<Index> which{0, 2, 3};
  mutator.damage(which);
  nearest_on_cage(cage, points, which);
}

template <int Dim>
void evaluate(Mutator& mutator) {
  const auto& [cage, mesh, name] = valid<Dim>().sample;
  const bool is_valid = mutator.below(2) == 0;
  const Evaluator<Dim> evaluator(is_valid ? cage : some_cage<Dim>(mutator),
                                 is_valid ? mesh : some_mesh<Dim>(mutator),
                                 some_weights<Dim>(mutator), some_policy(mutator));
  const auto placement = evaluator.place(some_points<Dim>(mutator));
  evaluator.weights(placement);
  auto pose = evaluator.pose(some_pose<Dim>(mutator));
  mutator.damage(pose.vertices);
  mutator.damage(pose.control_points);
  evaluator.move(placement, pose);
}

template <int Dim>
void compute_pointwise(Mutator& mutator) {
  const auto cage = some_cage<Dim>(mutator);
  const auto points = some_points<Dim>(mutator);
  const auto coordinates = some_coordinates(mutator);
  mutator.call_one({
      [&] { pointwise_coordinates(cage, points, coordinates); },
      [&] {
        pointwise_coordinates(cage, place_points(cage, points, some_policy(mutator)), coordinates,
                              mutator.below(2) == 0);
      },
      [&] { mean_value_coordinates(cage, points); },
      [&] { maximum_entropy_coordinates(cage, points); },
      [&] { maximum_likelihood_coordinates(cage, points); },
      [&] {
        if constexpr (Dim == 2) blended_coordinates(cage, points);
      },
      [&] { green_coordinates(cage, points); },
      [&] { control_points_and_normals(cage, some_pose<Dim>(mutator)); },
  });
}

// ---------------------------------------------------------------------------------------- weights

template <int Dim>
void move_points(Mutator& mutator) {
  const auto weights = some_weights<Dim>(mutator);
  const auto moved = deform<Dim>(weights, some_pose<Dim>(mutator));
  displacements<Dim>(some_points<Dim>(mutator), moved);
}

template <int Dim>
void take_arrays(Mutator& mutator) {
  const auto& weights = valid<Dim>().weights;
  auto starts = weights.starts();
  auto control_points = weights.control_points();
  auto values = weights.values();
  mutator.damage(starts);
  mutator.damage(control_points);
  mutator.damage(values);
  const SparseWeights taken(weights.num_control_points(), starts, control_points, values);
  deform<Dim>(taken, some_pose<Dim>(mutator));
}

template <int Dim>
void reduce(Mutator& mutator) {
  const auto& mesh = valid<Dim>().sample.mesh;
  PointList<Dim> control_points = valid<Dim>().sample.cage.points;
  mutator.damage(control_points);
  const auto points = some_points<Dim>(mutator);
  const auto weights = some_weights<Dim>(mutator);
  static const EdgeList all = edges_of_cells(mesh);
  const auto edges = some_edges(mutator, all);
  const auto poses = some_poses<Dim>(mutator);
  SparsifyOptions options;
  options.max_influences = Dim + 1 + mutator.below(3);
  mutator.call_one({
      [&] { sparsify(control_points, points, weights, options); },
      [&] { reduce_by_poisson(control_points, points, edges, weights, poses, options); },
      [&] { reduce_influences(control_points, points, edges, weights, poses, options); },
      [&] {
        poisson_cost(control_points, points, edges, weights, some_weights<Dim>(mutator), poses);
      },
      [&] {
        std::vector<Index> some{0, 3, 5};
        mutator.damage(some);
        const auto projected = project_non_negative(control_points, points, weights, some);
      },
      [&] {
        weight_error(weights, some_weights<Dim>(mutator));
        count_influences(weights);
      },
      [&] { deformation_error<Dim>(poses, weights, some_weights<Dim>(mutator)); },
      [&] { edge_error<Dim>(points, edges, poses, weights, some_weights<Dim>(mutator)); },
      [&] {
        independent_poses<Dim>(control_points, 2);
        smooth_poses<Dim>(control_points, 2);
      },
  });
}

template <int Dim>
void connect(Mutator& mutator) {
  std::vector<Index> polygon{0, 1, 2, 3}, polyline{3, 4};
  mutator.damage(polygon);
  mutator.damage(polyline);
  edges_of_polygons<Dim>(some_points<Dim>(mutator), {polygon}, {polyline});
}

template <int Dim>
void transfer(Mutator& mutator) {
  const auto cage = some_cage<Dim>(mutator);
  const auto mesh = some_mesh<Dim>(mutator);
  Eigen::VectorXd distances;
  bound_by<Dim>(cage, mesh.points, some_weights<Dim>(mutator))
      .transferred(mesh.cells.template topRows<3>(), some_points<Dim>(mutator), {}, 0.1,
                   &distances);
}

template <int Dim>
void judge(Mutator& mutator) {
  const auto cage = some_cage<Dim>(mutator);
  const auto mesh = some_mesh<Dim>(mutator);
  const auto weights = some_weights<Dim>(mutator);
  mutator.call_one({
      [&] { measure_quality<Dim>(cage.points, some_points<Dim>(mutator), weights); },
      [&] { find_violations(check_weights(cage, some_points<Dim>(mutator), weights)); },
      [&] { find_violations(check_weights(cage, mesh, weights)); },
      [&] { total_variation(mesh, weights); },
      [&] { objective(mesh, some_phi<Dim>(mutator), weights); },
  });
}

template <int Dim>
void add_calls(std::vector<Call>& calls) {
  const std::string in = Dim == 2 ? "_2d" : "_3d";
  for (const auto& [name, make] : std::initializer_list<std::pair<const char*, void (*)(Mutator&)>>{
           {"solve", solve_once<Dim>},
           {"coordinates", compute_other<Dim>},
           {"solve_with_topology", solve_with_topology<Dim>},
           {"solve_problem", solve_problem<Dim>},
           {"judge_problem", judge_problem<Dim>},
           {"set_up", set_up<Dim>},
           {"solver", solve_and_move<Dim>},
           {"cage", look_at_cage<Dim>},
           {"mesh", look_at_mesh<Dim>},
           {"boundary", find_boundary<Dim>},
           {"place", place<Dim>},
           {"place_near", place_near<Dim>},
           {"evaluator", evaluate<Dim>},
           {"pointwise", compute_pointwise<Dim>},
           {"deform", move_points<Dim>},
           {"sparse_weights", take_arrays<Dim>},
           {"reduce", reduce<Dim>},
           {"connect", connect<Dim>},
           {"transfer", transfer<Dim>},
           {"judge", judge<Dim>}}) {
    calls.push_back({name + in, make});
  }
}

}  // namespace

std::vector<Call> core_calls() {
  std::vector<Call> calls;
  add_calls<2>(calls);
  add_calls<3>(calls);
  return calls;
}

}  // namespace flbc::fuzz
