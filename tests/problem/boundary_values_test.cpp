// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/boundary_values.h"

#include "support/test.h"

namespace flbc::testing {
namespace {

template <int Dim>
BoundaryValues<Dim> values_of(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh) {
  return boundary_values(cage, mesh, build_topology(mesh));
}

TEST_IN_2D_AND_3D(BoundaryValuesTest, EqualTheJudgesBarycentricCoordinates) {
  for (const auto& sample : samples<Dim>()) {
    SCOPED_TRACE(sample.name);
    const auto boundary = values_of(sample.cage, sample.mesh);
    const auto expected = demanded_boundary_weights(sample.cage, sample.mesh);
    for (std::size_t b = 0; b < boundary.vertices.size(); ++b) {
      Eigen::VectorXd row = Eigen::VectorXd::Zero(sample.cage.size());
      boundary.scatter(static_cast<Index>(b), row);
      EXPECT_LT((row - expected.col(boundary.vertices[b])).cwiseAbs().maxCoeff(), 1e-12);
      EXPECT_NEAR(row.sum(), 1, 1e-15);
      EXPECT_EQ(boundary.boundary_index[boundary.vertices[b]], static_cast<Index>(b));
    }
    for (Index i = 0; i < sample.cage.size(); ++i) {
      EXPECT_TRUE(sample.mesh.points.col(boundary.control_vertices[i])
                      .isApprox(sample.cage.points.col(i), 1e-14));
    }
  }
}

// Points on an edge of the cage belong to the edge: exactly two control points in 3D too.
TEST_IN_2D_AND_3D(BoundaryValuesTest, PointsOnCageEdgesHaveExactZerosElsewhere) {
  const auto sample = make_sample<Dim>(Shape::kBox, 3);
  const auto boundary = values_of(sample.cage, sample.mesh);
  int on_edges = 0;
  for (std::size_t b = 0; b < boundary.vertices.size(); ++b) {
    const Vector<Dim> point = sample.mesh.points.col(boundary.vertices[b]);
    int inner_axes = 0;  // of the unit box
    for (const double x : point) inner_axes += x > 1e-9 && x < 1 - 1e-9 ? 1 : 0;
    if (inner_axes != 1) continue;
    ++on_edges;
    EXPECT_EQ((boundary.values.col(b).array() > 0).count(), 2);
  }
  EXPECT_EQ(on_edges, Dim == 2 ? 8 : 24);
}

// Rounding of coordinates to single precision is made good; vertices farther away stay.
TEST_IN_2D_AND_3D(BoundaryValuesTest, SnapsVerticesThatLostDigits) {
  for (const auto& sample : samples<Dim>()) {
    SCOPED_TRACE(sample.name);
    const auto topology = build_topology(sample.mesh);
    auto rounded = sample.mesh;
    rounded.points = sample.mesh.points.template cast<float>().template cast<double>();
    snap_to_cage(sample.cage, topology, 1e-6, rounded);
    const auto boundary = boundary_values(sample.cage, rounded, topology);
    const auto expected = demanded_boundary_weights(sample.cage, sample.mesh);
    for (std::size_t b = 0; b < boundary.vertices.size(); ++b) {
      Eigen::VectorXd row = Eigen::VectorXd::Zero(sample.cage.size());
      boundary.scatter(static_cast<Index>(b), row);
      EXPECT_LT((row - expected.col(boundary.vertices[b])).cwiseAbs().maxCoeff(), 1e-5);
      const Vector<Dim> reproduced = sample.cage.points * row;
      EXPECT_LT((reproduced - rounded.points.col(boundary.vertices[b])).norm(), 1e-13);
    }
    auto exact = sample.mesh;
    EXPECT_THROW(snap_to_cage(sample.cage, topology, -1, exact), OptionError);
    snap_to_cage(sample.cage, topology, 1e-6, exact);
    EXPECT_LT((exact.points - sample.mesh.points).cwiseAbs().maxCoeff(), 1e-14);
    auto far = sample.mesh;
    far.points *= 1.01;
    const PointList<Dim> before = far.points;
    snap_to_cage(sample.cage, topology, 1e-6, far);
    EXPECT_LT((far.points - before).cwiseAbs().maxCoeff(), 1e-5);
  }
}

TEST_IN_2D_AND_3D(BoundaryValuesTest, RefusesAMeshOfAnotherCage) {
  const auto sample = make_sample<Dim>(Shape::kBox, 2);
  auto bigger = sample.cage;
  bigger.points *= 1.01;
  EXPECT_THROW(values_of(bigger, sample.mesh), InputError);

  // A control point in the middle of a facet's edge, where the mesh has no vertex.
  const auto coarse = make_sample<Dim>(Shape::kBox, 1);
  auto refined = make_sample<Dim>(Shape::kBox, 1).cage;
  refined.points.conservativeResize(Dim, refined.points.cols() + 1);
  const auto added = static_cast<Index>(refined.points.cols() - 1);
  const Index a = refined.facets(0, 0);
  const Index b = refined.facets(1, 0);
  refined.points.col(added) = (refined.points.col(a) + refined.points.col(b)) / 2;
  const auto old = refined.facets;
  refined.facets.resize(Dim, old.cols() * 2);
  Index count = 0;
  for (Index f = 0; f < old.cols(); ++f) {  // split every facet with the edge a b
    const bool has_edge = (old.col(f).array() == a).any() && (old.col(f).array() == b).any();
    refined.facets.col(count) = old.col(f);
    if (has_edge) {
      for (Index& v : refined.facets.col(count).reshaped()) v = v == a ? added : v;
      refined.facets.col(++count) = old.col(f);
      for (Index& v : refined.facets.col(count).reshaped()) v = v == b ? added : v;
    }
    ++count;
  }
  refined.facets.conservativeResize(Dim, count);
  expect_error<InputError>([&] { values_of(refined, coarse.mesh); },
                           {"is not a vertex of the domain mesh"});
}

// A ring one cell thick from which a cell is taken keeps all its vertices on the cage.
TEST_IN_2D_AND_3D(BoundaryValuesTest, RefusesAMeshWithAGapAcrossTheCage) {
  const auto sample = make_sample<Dim>(Shape::kRing, 1);
  int refused = 0;
  for (Index s = 0; s < sample.mesh.num_cells(); ++s) {
    auto mesh = sample.mesh;
    mesh.cells.col(s) = mesh.cells.rightCols(1).eval();
    mesh.cells.conservativeResize(Dim + 1, mesh.num_cells() - 1);
    try {
      values_of(sample.cage, mesh);
      ADD_FAILURE() << "accepted a mesh without cell " << s;
    } catch (const InputError& error) {
      refused += std::string(error.what()).find("the mesh must fill the cage") != std::string::npos;
    }
  }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace flbc::testing
