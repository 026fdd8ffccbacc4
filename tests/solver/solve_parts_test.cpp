// SPDX-License-Identifier: BSD-3-Clause
// Cages of several parts: each part is solved as if it were alone, for any numbering.
#include "flbc/check.h"
#include "flbc/coordinates.h"
#include "flbc/report.h"
#include "support/hollow_sample.h"

namespace flbc::testing {
namespace {

// The number of element k of the second of two lists that take turns as long as both have any; of
// the first list with `first`.
Index in_turn(Index k, Index own_size, Index other_size, bool first) {
  const Index both = std::min(own_size, other_size);
  return k < both ? 2 * k + (first ? 0 : 1) : both + k;
}

std::vector<Index> in_turns(Index own_size, Index other_size, bool first) {
  std::vector<Index> numbers;
  for (Index k = 0; k < own_size; ++k) numbers.push_back(in_turn(k, own_size, other_size, first));
  return numbers;
}

// Two disjoint samples, or one in the hole of the other, as one cage and mesh.
template <int Dim>
struct TwoParts {
  std::vector<Sample<Dim>> alone;
  std::vector<std::vector<Index>> control_points{}, vertices{};  // of each in the whole
  Sample<Dim> whole{};

  TwoParts(Sample<Dim> a, Sample<Dim> b) : alone{std::move(a), std::move(b)} {
    std::vector<MeshPart<Dim>> parts;
    whole.cage.points.resize(Dim, alone[0].cage.size() + alone[1].cage.size());
    Index num_facets = 0;
    for (int k = 0; k < 2; ++k) {
      const auto& [own, other] = std::tie(alone[k], alone[1 - k]);
      normalize_and_validate(alone[k].mesh);
      control_points.push_back(in_turns(own.cage.size(), other.cage.size(), k == 0));
      vertices.push_back(in_turns(own.mesh.num_vertices(), other.mesh.num_vertices(), k == 0));
      parts.push_back({own.mesh, vertices[k]});
      whole.cage.points(Eigen::all, control_points[k]) = own.cage.points;
      num_facets += static_cast<Index>(own.cage.facets.cols());
    }
    whole.mesh = join_parts(parts);
    whole.cage.facets.resize(Dim, num_facets);
    num_facets = 0;
    for (int k = 0; k < 2; ++k) {
      for (const auto& facet : alone[k].cage.facets.colwise()) {
        for (int c = 0; c < Dim; ++c) {
          whole.cage.facets(c, num_facets) = control_points[k][facet[c]];
        }
        ++num_facets;
      }
    }
  }
};

template <int Dim>
Sample<Dim> scaled(Sample<Dim> sample, double factor, double offset) {
  sample.cage.points = (sample.cage.points.array() * factor + offset).matrix();
  sample.mesh.points = (sample.mesh.points.array() * factor + offset).matrix();
  return sample;
}

template <int Dim>
std::vector<TwoParts<Dim>> pairs() {
  std::vector<TwoParts<Dim>> result;
  result.emplace_back(make_sample<Dim>(Shape::kCorner, 4, 0.2),
                      scaled(make_sample<Dim>(Shape::kStar, 4, 0.2), 3, 20));
  // A star in a hole, of which nothing touches the other.
  result.emplace_back(scaled(make_sample<Dim>(Shape::kStar, 3), 0.01, 0.3),
                      make_sample<Dim>(Shape::kRing, 3, 0.1));
  auto hollow = make_hollow_sample<Dim>();
  const Index n = hollow.cage.size() / 2;  // the first half of them bounds the hole from outside
  const Vector<Dim> middle = hollow.cage.points.rightCols(n).rowwise().mean();
  auto core = scaled(make_sample<Dim>(Shape::kBox, 3, 0.1), 0.05, 0);
  const Vector<Dim> shift = middle - Vector<Dim>::Constant(0.025);
  core.cage.points.colwise() += shift;
  core.mesh.points.colwise() += shift;
  result.emplace_back(std::move(hollow), std::move(core));
  return result;
}

// \param compute  of (cage, mesh)
template <int Dim, class Compute>
void expect_as_alone(const TwoParts<Dim>& pair, const Compute& compute) {
  const Solution whole = compute(pair.whole.cage, pair.whole.mesh);
  EXPECT_TRUE(
      find_violations(check_weights(pair.whole.cage, pair.whole.mesh, whole.weights)).empty());
  ASSERT_EQ(whole.report.parts.size(), 2u);
  double objective = 0, bound = 0;
  int iterations = 0;
  for (int k = 0; k < 2; ++k) {
    const Solution alone = compute(pair.alone[k].cage, pair.alone[k].mesh);
    const auto& vertices = pair.vertices[k];
    EXPECT_EQ(WeightMatrix(whole.weights.dense()(pair.control_points[k], vertices)),
              alone.weights.dense());
    EXPECT_EQ(WeightMatrix(whole.weights.dense()(pair.control_points[1 - k], vertices))
                  .cwiseAbs()
                  .maxCoeff(),
              0.0);
    const auto& part = whole.report.parts[k];
    EXPECT_EQ(part.iterations, alone.report.iterations);
    EXPECT_EQ(part.vertices, alone.report.vertices);
    objective += alone.report.objective;
    bound += alone.report.certificate.lower_bound;
    iterations = std::max(iterations, alone.report.iterations);
  }
  const auto& report = whole.report;
  EXPECT_EQ(report.control_points, pair.whole.cage.size());
  EXPECT_EQ(report.vertices, pair.whole.mesh.num_vertices());
  EXPECT_EQ(report.cells, pair.whole.mesh.num_cells());
  EXPECT_EQ(report.iterations, iterations);
  if (iterations == 0) return;  // no objective
  EXPECT_EQ(report.objective, objective);
  EXPECT_EQ(report.certificate.lower_bound, bound);
  if (bound > 0) {
    EXPECT_NEAR(report.certificate.relative_gap, 1 - bound / report.certificate.objective, 1e-12);
  }
}

TEST_IN_2D_AND_3D(SolvePartsTest, EachIsAsAlone) {
  int number = 0;
  for (const auto& pair : pairs<Dim>()) {
    SCOPED_TRACE(number++);
    for (const auto coordinates : {Coordinates::kHarmonic, Coordinates::kMeanValue}) {
      SCOPED_TRACE(name_of(coordinates));
      expect_as_alone(pair, [&](const auto& cage, const auto& mesh) {
        return compute_coordinates(cage, mesh, coordinates);
      });
    }
    for (const auto method :
         {Method::kWeights, Method::kGradient, Method::kPaper, Method::kLbc2014}) {
      SCOPED_TRACE(name_of(method));
      SolverOptions options{method};
      options.max_iterations = 40;
      options.certify = method == Method::kWeights;
      expect_as_alone(
          pair, [&](const auto& cage, const auto& mesh) { return solve(cage, mesh, options); });
    }
  }
}

TEST_IN_2D_AND_3D(SolvePartsTest, EachHasItsOwnReach) {
  for (const auto& pair : pairs<Dim>()) {
    SolverOptions options;
    options.max_iterations = 40;
    for (Index i = 0; i < pair.whole.cage.size(); ++i) options.reach.push_back(1 + i % 4);
    const auto whole = solve(pair.whole.cage, pair.whole.mesh, options).weights.dense();
    for (int k = 0; k < 2; ++k) {
      auto of_part = options;
      of_part.reach.clear();
      for (const Index i : pair.control_points[k]) of_part.reach.push_back(options.reach[i]);
      const auto& [cage, mesh, name] = pair.alone[k];
      EXPECT_EQ(WeightMatrix(whole(pair.control_points[k], pair.vertices[k])),
                solve(cage, mesh, of_part).weights.dense());
    }
    options.reach.pop_back();
    expect_error<OptionError>([&] { solve(pair.whole.cage, pair.whole.mesh, options); },
                              {"reach needs a factor for each"});
  }
}

// The objective of the joined weights, which the library adds up cell by cell, is the sum.
TEST_IN_2D_AND_3D(SolvePartsTest, TotalVariationAddsUp) {
  const auto pair = std::move(pairs<Dim>().front());
  SolverOptions options;
  options.smoothness = 0;
  options.phi = DistanceScheme::kConstant;
  const auto [weights, report] = solve(pair.whole.cage, pair.whole.mesh, options);
  EXPECT_EQ(report.status, SolveStatus::kConverged);
  EXPECT_NEAR(total_variation(pair.whole.mesh, weights), report.objective,
              1e-10 * report.objective);
}

TEST_IN_2D_AND_3D(SolvePartsTest, ProgressIsThatOfTheWhole) {
  const auto pair = std::move(pairs<Dim>().front());
  SolverOptions options;
  std::vector<int> to_come;
  std::vector<double> stages;
  Observer observer;
  observer.progress = [&](const Progress& progress) {
    to_come.push_back(progress.finer_levels);
    return true;
  };
  observer.stage = [&](Stage, double done) { stages.push_back(done); };
  options.certify = true;
  solve(pair.whole.cage, pair.whole.mesh, options, observer);
  ASSERT_FALSE(to_come.empty());
  EXPECT_EQ(to_come.front(), 1);
  EXPECT_EQ(to_come.back(), 0);
  EXPECT_TRUE(std::is_sorted(to_come.rbegin(), to_come.rend()));
  ASSERT_FALSE(stages.empty());
  EXPECT_NEAR(*std::max_element(stages.begin(), stages.end()), 1, 1e-12);

  int calls = 0;
  observer.progress = [&](const Progress&) { return ++calls < 2; };
  const auto stopped = solve(pair.whole.cage, pair.whole.mesh, options, observer);
  EXPECT_EQ(stopped.report.status, SolveStatus::kStopped);
  EXPECT_EQ(stopped.report.criterion, Criterion::kNone);
  // The other part makes one iteration, to have weights, and nobody is asked again.
  EXPECT_EQ(calls, 2);
  ASSERT_EQ(stopped.report.parts.size(), 2U);
  EXPECT_EQ(stopped.report.parts[1].iterations, 1);
  EXPECT_TRUE(
      find_violations(check_weights(pair.whole.cage, pair.whole.mesh, stopped.weights.dense()))
          .empty());
}

TEST_IN_2D_AND_3D(SolvePartsTest, PartsOfMeshAndCageMustBeTheSame) {
  const auto pair = std::move(pairs<Dim>().front());
  const auto& alone = pair.alone;
  const auto& whole = pair.whole;
  // A mesh of one part only.
  expect_refused("control point 1", [&] { solve(whole.cage, alone[0].mesh); });
  // A cage of one part only.
  expect_refused("vertex", [&] { solve(alone[0].cage, whole.mesh); });
  // Classes that keep a state hold one part.
  expect_refused("not connected", [&] { Solver<Dim>(whole.cage, whole.mesh); });
  expect_refused("2 parts",
                 [&] { make_problem(whole.cage, whole.mesh, DistanceScheme::kSquare, 0); });
}

}  // namespace
}  // namespace flbc::testing
