// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/domain_mesh.h"

#include "flbc/sparsify.h"
#include "flbc/sparsify_error.h"
#include "problem/laplacian.h"
#include "support/feasible_vertices.h"
#include "support/mesh_checks.h"

namespace flbc::testing {
namespace {

// sum k |f(a) - f(b)|^2
double energy(const EdgeList& edges, const Eigen::VectorXd& values) {
  double sum = 0;
  for (std::size_t e = 0; e < edges.ends.size(); ++e) {
    const double step = values[edges.ends[e][0]] - values[edges.ends[e][1]];
    sum += edges.weights[e] * step * step;
  }
  return sum;
}

template <int Dim>
DomainMesh<Dim> regular_cell() {
  DomainMesh<Dim> mesh;
  mesh.points.resize(Dim, Dim + 1);
  mesh.cells.resize(Dim + 1, 1);
  for (int k = 0; k <= Dim; ++k) mesh.cells(k, 0) = k;
  if constexpr (Dim == 2) {
    mesh.points << 0, 1, 0.5, 0, 0, std::sqrt(0.75);
  } else {
    mesh.points << 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1, 1;
  }
  return mesh;
}

TEST_IN_2D_AND_3D(EdgeListTest, EdgesOfCellsAreTheNonZerosOfTheStiffnessMatrix) {
  for (const auto& sample : samples<Dim>()) {
    SCOPED_TRACE(sample.name);
    const auto edges = edges_of_cells(sample.mesh);
    ASSERT_EQ(edges.weights.size(), edges.ends.size());
    std::set<std::array<Index, 2>> expected;
    for (const auto cell : sample.mesh.cells.colwise()) {
      for (const Index a : cell) {
        for (const Index b : cell) {
          if (a < b) expected.insert({a, b});
        }
      }
    }
    EXPECT_EQ(std::vector(expected.begin(), expected.end()), edges.ends);
    for (const double weight : edges.weights) EXPECT_GT(weight, 0);
    EXPECT_NO_THROW(validate(edges, sample.mesh.points.cols()));
  }
}

TEST_IN_2D_AND_3D(EdgeListTest, OnARegularCellTheEnergyIsThatOfFiniteElements) {
  const auto mesh = regular_cell<Dim>();
  const Eigen::MatrixXd stiffness = stiffness_matrix(mesh);
  Numbers numbers(3);
  for (int k = 0; k < 5; ++k) {
    const Eigen::VectorXd values = numbers.matrix(Dim + 1, 1, -1, 1);
    EXPECT_NEAR(energy(edges_of_cells(mesh), values), values.dot(stiffness * values), 1e-14);
  }
}

TEST_IN_2D_AND_3D(EdgeListTest, TheSumOverCoordinatesIsTheMeasure) {
  for (const auto& sample : samples<Dim>()) {
    SCOPED_TRACE(sample.name);
    const double measure = total_volume(sample.mesh);
    double sum = 0;
    const auto edges = edges_of_cells(sample.mesh);
    for (int axis = 0; axis < Dim; ++axis) {
      sum += energy(edges, sample.mesh.points.row(axis).transpose());
    }
    EXPECT_NEAR(sum, Dim * measure, 1e-9 * measure);  // as the integral of |grad x|^2
  }
}

TEST(EdgesOfPolygons, OfTrianglesAreThoseOfCells) {
  const auto sample = make_sample<2>(Shape::kRing, 3, 0.1);
  std::vector<std::vector<Index>> polygons;
  for (const auto cell : sample.mesh.cells.colwise()) {
    polygons.emplace_back(cell.begin(), cell.end());
  }
  const auto expected = edges_of_cells(sample.mesh);
  const auto edges = edges_of_polygons<2>(sample.mesh.points, polygons);
  PointList<3> lifted = PointList<3>::Constant(3, sample.mesh.points.cols(), 7);
  lifted.topRows<2>() = sample.mesh.points;
  const auto in_space = edges_of_polygons<3>(lifted, polygons);
  ASSERT_EQ(edges.ends, expected.ends);
  ASSERT_EQ(in_space.ends, expected.ends);
  for (std::size_t e = 0; e < edges.ends.size(); ++e) {
    EXPECT_NEAR(edges.weights[e], expected.weights[e], 1e-12);
    EXPECT_NEAR(in_space.weights[e], expected.weights[e], 1e-12);
  }
}

TEST(EdgesOfPolygons, QuadsAndLines) {
  // Two unit squares side by side, and a line of two pieces, the second of length 2.
  PointList<2> points{{0, 1, 2, 0, 1, 2, 5, 6, 8}, {0, 0, 0, 1, 1, 1, 0, 0, 0}};
  const auto edges = edges_of_polygons<2>(points, {{0, 1, 4, 3}, {1, 2, 5, 4}}, {{6, 7, 8}});
  ASSERT_EQ(edges.ends.size(), 7 + 2);
  for (std::size_t e = 0; e < edges.ends.size(); ++e) {
    const auto [a, b] = edges.ends[e];
    // The usual stencil of grids, halved at the border; on lines 1 / length.
    const double expected = a == 1 && b == 4 ? 1 : a == 7 ? 0.5 : a == 6 ? 1 : 0.5;
    EXPECT_DOUBLE_EQ(edges.weights[e], expected) << a << " " << b;
  }
  // A closed line has no edge from a vertex to itself.
  EXPECT_EQ(edges_of_polygons<2>(points, {}, {{0, 1, 1, 4, 0}}).ends.size(), 3);
  EXPECT_TRUE(edges_of_polygons<2>(points, {}).ends.empty());
}

TEST(EdgesOfPolygons, DegenerateOnesKeepFiniteWeights) {
  PointList<3> points = PointList<3>::Zero(3, 5);
  points.col(1) << 1, 0, 0;
  points.col(2) << 2, 0, 0;
  points.col(4) << 0, 1, 0;
  // No area; two points that coincide; everything in one place.
  for (const auto& polygons : std::vector<std::vector<std::vector<Index>>>{
           {{0, 1, 2}}, {{0, 1, 3}, {3, 1, 4}}, {{0, 3}}}) {
    const auto edges = edges_of_polygons<3>(points, polygons);
    EXPECT_FALSE(edges.ends.empty());
    EXPECT_NO_THROW(validate(edges, 5));
  }
}

TEST(EdgesOfPolygons, RefusesWhatCannotBe) {
  const PointList<3> points = PointList<3>::Random(3, 4);
  const std::vector<std::vector<Index>> polygons{{0, 1, 2}, {0, 1, 4}}, polylines{{0, -1}};
  expect_error<InputError>([&] { edges_of_polygons<3>(points, polygons); },
                           {"polygon 1 has vertex 4", "4 points"});
  expect_error<InputError>([&] { edges_of_polygons<3>(points, {}, polylines); },
                           {"polyline 0 has vertex -1"});
  DomainMesh<3> mesh{points, CellList<3>(4, 1)};
  mesh.cells << 0, 1, 2, 9;
  expect_error<InputError>([&] { edges_of_cells(mesh); }, {"cell 0 has vertex 9"});
  EdgeList edges{{{0, 1}, {1, 4}}, {}};
  expect_error<InputError>([&] { validate(edges, 4); }, {"edge 1 ends at point 4"});
  EXPECT_NO_THROW(validate(edges, 5));
  edges.weights = {1};
  expect_error<InputError>([&] { validate(edges, 5); }, {"2 edges", "weights of 1"});
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    edges.weights = {1, bad};
    expect_error<InputError>([&] { validate(edges, 5); }, {"weight of edge 1"});
  }
}

TEST_IN_2D_AND_3D(EdgeListTest, EdgeErrorIsRelativeToTheEdges) {
  Numbers numbers(4);
  // Points 0 and 1 at a distance of 2, and 2 at a distance of 1 from 1.
  PointList<Dim> points = PointList<Dim>::Zero(Dim, 3);
  points(0, 1) = points(0, 2) = 2;
  points(1, 2) = 1;
  WeightMatrix before = numbers.matrix(Dim + 2, 3, 0, 1), after = before;
  const EdgeList edges{{{0, 1}, {2, 1}}, {3, 0.5}};
  const std::vector<PointList<Dim>> poses{numbers.matrix(Dim, Dim + 2, -1, 1),
                                          numbers.matrix(Dim, Dim + 2, -1, 1)};
  EXPECT_EQ(edge_error<Dim>(points, edges, poses, before, after).rms, 0);
  // Moving all points alike changes no edge.
  after.colwise() += numbers.matrix(Dim + 2, 1, -1, 1).col(0);
  EXPECT_NEAR(edge_error<Dim>(points, edges, poses, before, after).max, 0, 1e-14);
  const Eigen::VectorXd change = numbers.matrix(Dim + 2, 1, -1, 1);
  after.col(0) += change;
  const double first = (poses[0] * change).norm(), second = (poses[1] * change).norm();
  const auto error = edge_error<Dim>(points, edges, poses, before, after);
  EXPECT_NEAR(error.max, std::max(first, second) / 2, 1e-13);
  const double mean = (first * first + second * second) / 2;
  EXPECT_NEAR(error.rms, std::sqrt(3 * mean / (3 * 4 + 0.5 * 1)), 1e-13);
  // An edge without weights counts 1; one without length counts for rms alone.
  points(0, 1) = 0;
  points(1, 2) = 0;
  const auto unit = edge_error<Dim>(points, {{{0, 1}, {2, 1}}, {}}, poses, before, after);
  EXPECT_EQ(unit.max, 0);
  EXPECT_NEAR(unit.rms, std::sqrt(mean / 4), 1e-13);

  EXPECT_THROW(edge_error<Dim>(points, edges, poses, before, WeightMatrix(after.leftCols(2))),
               InputError);
  EXPECT_THROW(edge_error<Dim>(points.leftCols(2), edges, poses, before, after), InputError);
  EXPECT_THROW(edge_error<Dim>(points, {{{0, 3}}, {}}, poses, before, after), InputError);
  EXPECT_THROW(edge_error<Dim>(points, edges, {poses[0].leftCols(2)}, before, after), InputError);
}

}  // namespace
}  // namespace flbc::testing
