// SPDX-License-Identifier: BSD-3-Clause
// The band next to masks in which weights fade out: creases, phi itself, and all ways to solve.
#include "support/judge.h"
#include "support/refined_sample.h"
#include "support/solver_options.h"

namespace flbc::testing {
namespace {

// Control points at the right end must not move the left part of the middle.
template <int Dim>
Mask middle_of(const Sample<Dim>& sample, double to = 0.35) {
  Mask mask;
  for (Index i = 0; i < sample.cage.size(); ++i) {
    if (sample.cage.points(0, i) > 0.9) mask.control_points.push_back(i);
  }
  for (Index v = 0; v < sample.mesh.num_vertices(); ++v) {
    const Vector<Dim> x = sample.mesh.points.col(v);
    const bool in_middle = ((x.array() - 0.5).abs().tail(Dim - 1) < 0.25).all();
    if (in_middle && x[0] > 0 && x[0] < to) mask.points.push_back(v);
  }
  return mask;
}

// Bands of a few cells.
template <int Dim>
constexpr double kFalloff = Dim == 2 ? 0.1 : 0.2;

template <int Dim>
Sample<Dim> box(int resolution = Dim == 2 ? 32 : 12) {
  return with_fine_cage<Dim>(Shape::kBox, 2, resolution);
}

struct Jumps {
  double rim = 0, all = 0;
};

// Largest jumps of the gradients of masked weights from cell to cell, times cage size, off the
// cage.
template <int Dim>
Jumps jumps_of(const Sample<Dim>& sample, const WeightMatrix& weights, const Mask& mask) {
  const auto& mesh = sample.mesh;
  const auto topology = build_topology(mesh);
  const auto on_boundary = boundary_vertices(topology, mesh.num_vertices());
  std::vector<bool> is_masked(mesh.num_vertices());
  for (const Index v : mask.points) is_masked[v] = true;
  const Eigen::MatrixXd of_mask = weights(mask.control_points, Eigen::all).transpose();
  const auto gradients = [&](Index s) -> Eigen::MatrixXd {
    Eigen::Matrix<double, Dim, Dim> edges;
    Eigen::MatrixXd rises(Dim, of_mask.cols());
    for (int k = 0; k < Dim; ++k) {
      const Index from = mesh.cells(0, s), to = mesh.cells(k + 1, s);
      edges.row(k) = (mesh.points.col(to) - mesh.points.col(from)).transpose();
      rises.row(k) = of_mask.row(to) - of_mask.row(from);
    }
    return edges.inverse() * rises;
  };
  Jumps jumps;
  for (Index f = 0; f < topology.sides.cols(); ++f) {
    const Index a = topology.sides(0, f), b = topology.sides(1, f);
    int masked = 0, outer = b < 0 ? 1 : 0;
    for (const Index s : {a, b}) {
      for (int k = 0; s >= 0 && k <= Dim; ++k) {
        masked += is_masked[mesh.cells(k, s)] ? 1 : 0;
        outer += on_boundary[mesh.cells(k, s)] ? 1 : 0;
      }
    }
    if (outer > 0) continue;
    const double jump = (gradients(a) - gradients(b)).colwise().norm().maxCoeff() *
                        bounding_box_diagonal(sample.cage.points);
    jumps.all = std::max(jumps.all, jump);
    if (masked > 0 && masked < 2 * (Dim + 1)) jumps.rim = std::max(jumps.rim, jump);
  }
  return jumps;
}

TEST_IN_2D_AND_3D(FalloffTest, WeightsFadeOutBeforeAMask) {
  const auto sample = box<Dim>();
  const auto mask = middle_of(sample);
  const auto jumps = [&](const SolverOptions& options) {
    const auto weights = solve(sample.cage, sample.mesh, options).weights.dense();
    expect_coordinates(sample.cage, sample.mesh, weights);
    EXPECT_GE(weights.minCoeff(), 0);
    if (!options.masks.empty()) {
      EXPECT_TRUE((weights(mask.control_points, mask.points).array() == 0).all());
    }
    return jumps_of(sample, weights, mask);
  };
  SolverOptions options;
  options.tolerance = 1e-7;
  const auto free = jumps(options);
  options.masks = {mask};
  const auto hard = jumps(options);
  EXPECT_GT(hard.rim, 1.3 * free.rim) << "there is no crease";
  options.falloff = kFalloff<Dim>;
  const auto soft = jumps(options);
  EXPECT_LT(soft.rim, 0.5 * free.rim);
  EXPECT_LT(soft.all, 1.2 * free.all);
}

// By how much phi of a control point is larger with falloff, by cell.
template <int Dim>
Eigen::VectorXd added(const Sample<Dim>& sample, SolverOptions options, Index i) {
  const auto phi = [&] {
    return Solver<Dim>(sample.cage, sample.mesh, options).problem().phi.dense().row(i).eval();
  };
  const Eigen::VectorXd with = phi();
  options.falloff = 0;
  return with - Eigen::VectorXd(phi());
}

// The square of the nearness, which follows from straight distances in a convex domain.
TEST_IN_2D_AND_3D(FalloffTest, PhiGrowsTowardTheMask) {
  const int resolution = Dim == 2 ? 16 : 8;
  const auto sample = box<Dim>(resolution);
  const auto& mesh = sample.mesh;
  SolverOptions options;
  options.masks = {middle_of(sample)};
  options.falloff = 0.2;
  const auto mask = options.masks[0];
  const double width = 0.2 * bounding_box_diagonal(sample.cage.points);
  const auto found = added(sample, options, mask.control_points[0]);
  double largest = 0;
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    double nearness = 0;
    for (const Index v : mesh.cells.col(s)) {
      const double distance = (mesh.points(Eigen::all, mask.points).colwise() - mesh.points.col(v))
                                  .colwise()
                                  .norm()
                                  .minCoeff();
      nearness += std::max(0.0, 1 - distance / width) / (Dim + 1);
    }
    EXPECT_NEAR(std::sqrt(std::max(0.0, found[s])), nearness, 1.0 / resolution / width) << s;
    largest = std::max(largest, found[s]);
  }
  EXPECT_NEAR(largest, 1, 1e-6);
  EXPECT_EQ(added(sample, options, 0).norm(), 0) << "not masked";
}

// The arms of a corner are near each other only across the gap.
TEST_IN_2D_AND_3D(FalloffTest, DistancesGoAroundGaps) {
  const auto sample = make_sample<Dim>(Shape::kCorner, Dim == 2 ? 8 : 4, 0.2);
  const auto& mesh = sample.mesh;
  const auto at_tip = [&](Index v, int arm) {
    return mesh.points(arm, v) > 1.6 && mesh.points(1 - arm, v) > 0.4;
  };
  SolverOptions options;
  options.masks = {{{0}, {}}};
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    if (at_tip(v, 0)) options.masks[0].points.push_back(v);
  }
  options.falloff = 1.1 / bounding_box_diagonal(sample.cage.points);
  const auto found = added(sample, options, 0);
  EXPECT_GT(found.maxCoeff(), 0.5);
  double nearest = 9;
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    bool is_other = true;
    for (const Index v : mesh.cells.col(s)) is_other = is_other && at_tip(v, 1);
    if (!is_other) continue;
    const Vector<Dim> x = mesh.points.col(mesh.cells(0, s));
    nearest = std::min(nearest, (mesh.points(Eigen::all, options.masks[0].points).colwise() - x)
                                    .colwise()
                                    .norm()
                                    .minCoeff());
    EXPECT_EQ(found[s], 0) << s;
  }
  EXPECT_LT(nearest, 1.09);
}

// Problems made before, given phi, multilevel starts, and Solvers that knew other options.
TEST_IN_2D_AND_3D(FalloffTest, EveryWayToSolveAgrees) {
  auto sample = with_fine_cage<Dim>(Shape::kBox, 2, Dim == 2 ? 8 : 4);
  sample.mesh = refine(sample.mesh);
  SolverOptions options;
  options.distances = Distances::kExact;
  options.masks = {middle_of(sample)};
  options.falloff = kFalloff<Dim>;
  const auto optimum =
      solve(sample.cage, sample.mesh, many_iterations(2000, options)).weights.dense();
  const auto expect_optimal = [&](const char* what, const Solution& solution) {
    const auto weights = solution.weights.dense();
    EXPECT_LT(mean_squared_difference(sample.mesh, weights, optimum), 4e-6) << what;
  };
  solve_in_every_way(sample, options, expect_optimal);

  auto others = std::vector<SolverOptions>(4, options);
  others[0].masks.clear();
  others[1].falloff = 0;
  others[2].falloff = 0.6;
  others[3].masks = {middle_of(sample, 0.2)};
  for (std::size_t k = 0; k < others.size(); ++k) {
    Solver<Dim> solver(sample.cage, sample.mesh, others[k]);
    const auto before = solver.solve().weights.dense();
    EXPECT_GT(mean_squared_difference(sample.mesh, before, optimum), 1e-5) << k;
    solver.set_options(options);
    expect_optimal("a Solver", solver.solve());
    solver.set_options(others[k]);
    EXPECT_LT(mean_squared_difference(sample.mesh, solver.solve().weights.dense(), before), 8e-6);
  }
}

TEST_IN_2D_AND_3D(FalloffTest, WeightsAreProvedOptimal) {
  const auto sample = box<Dim>(Dim == 2 ? 16 : 6);
  SolverOptions options;
  options.masks = {middle_of(sample)};
  options.falloff = kFalloff<Dim>;
  options.certify = true;
  const auto report = solve(sample.cage, sample.mesh, many_iterations(2000, options)).report;
  EXPECT_LT(report.certificate.relative_gap, 1e-4);
}

TEST_IN_2D_AND_3D(FalloffTest, WithoutMasksItChangesNothing) {
  const auto sample = box<Dim>(Dim == 2 ? 16 : 6);
  SolverOptions options;
  const auto free = solve(sample.cage, sample.mesh);
  options.falloff = 0.1;
  EXPECT_TRUE(solve(sample.cage, sample.mesh, options).weights == free.weights);
}

TEST(FalloffTest, WrongWidthsAreRefused) {
  for (const double falloff : {-0.1, 1.1, std::nan("")}) {
    SolverOptions options;
    options.falloff = falloff;
    expect_refused<OptionError>("falloff must be in [0, 1]", [&] { validate(options); });
  }
}

}  // namespace
}  // namespace flbc::testing
