// SPDX-License-Identifier: BSD-3-Clause
// Tests of the test helpers: sample meshes and the reference measures.
#include <Eigen/Dense>

#include "support/harmonic_weights.h"
#include "support/mesh_checks.h"

namespace flbc::testing {
namespace {

using Eigen::MatrixXd;

TEST_IN_2D_AND_3D(SupportTest, JudgeAcceptsHarmonicCoordinates) {
  for (const auto& sample : samples<Dim>()) {
    SCOPED_TRACE(sample.name);
    const auto judgement = judge<Dim>(sample.cage, sample.mesh, harmonic_weights(sample), 1e-12);
    EXPECT_LT(judgement.partition_error, 1e-12);
    EXPECT_LT(judgement.reproduction_error, 1e-12);
    EXPECT_LT(judgement.lagrange_error, 1e-12);
    EXPECT_LT(judgement.linearity_error, 1e-12);
  }
}

TEST_IN_2D_AND_3D(SupportTest, JudgeSeesBrokenInteriorWeights) {
  const auto sample = make_sample<Dim>(Shape::kBox, 4, 0.2);
  const MatrixXd good = harmonic_weights(sample);
  const auto interior = interior_vertices(sample.mesh);
  const auto v = std::find(interior.begin(), interior.end(), true) - interior.begin();
  const Index last = sample.cage.size() - 1;  // the corner (1, .., 1)

  MatrixXd broken = good;
  broken(last, v) += 0.01;
  auto judgement = judge<Dim>(sample.cage, sample.mesh, broken);
  EXPECT_NEAR(judgement.partition_error, 0.01, 1e-12);
  EXPECT_NEAR(judgement.reproduction_error, 0.01, 1e-12);  // |(1, .., 1)| is the cage's diagonal
  EXPECT_EQ(judgement.worst_reproduced, Vector<Dim>(sample.mesh.points.col(v)));
  EXPECT_LT(judgement.linearity_error, 1e-12);

  broken = good;
  broken(1, v) = -2;
  judgement = judge<Dim>(sample.cage, sample.mesh, broken);
  EXPECT_EQ(judgement.min_weight, -2);
  EXPECT_EQ(judgement.local_minima[1], 1);
  EXPECT_EQ(judgement.local_maxima[1], 0);
  EXPECT_EQ(judge<Dim>(sample.cage, sample.mesh, broken, 10).local_minima[1], 0);

  broken(1, v) = 2;
  judgement = judge<Dim>(sample.cage, sample.mesh, broken);
  EXPECT_EQ(judgement.local_minima[1], 0);
  EXPECT_EQ(judgement.local_maxima[1], 1);

  broken(1, v) = std::numeric_limits<double>::quiet_NaN();
  judgement = judge<Dim>(sample.cage, sample.mesh, broken);
  EXPECT_TRUE(std::isinf(judgement.partition_error));
  EXPECT_TRUE(std::isinf(judgement.reproduction_error));
  EXPECT_TRUE(std::isinf(judgement.min_weight));
}

TEST_IN_2D_AND_3D(SupportTest, JudgeSeesBrokenBoundaryWeights) {
  const auto sample = make_sample<Dim>(Shape::kCorner, 3);
  const MatrixXd good = harmonic_weights(sample);
  Index control = -1;
  Index between = -1;
  const auto interior = interior_vertices(sample.mesh);
  for (Index v = 0; v < sample.mesh.num_vertices(); ++v) {
    if (!interior[v]) (good.col(v).maxCoeff() > 1 - 1e-9 ? control : between) = v;
  }
  MatrixXd broken = good;
  broken(0, control) += 0.5;
  auto judgement = judge<Dim>(sample.cage, sample.mesh, broken);
  EXPECT_NEAR(judgement.lagrange_error, 0.5, 1e-12);
  EXPECT_NEAR(judgement.linearity_error, 0.5, 1e-12);

  broken = good;
  broken(0, between) -= 0.25;
  judgement = judge<Dim>(sample.cage, sample.mesh, broken);
  EXPECT_LT(judgement.lagrange_error, 1e-12);
  EXPECT_NEAR(judgement.linearity_error, 0.25, 1e-12);

  auto mesh = sample.mesh;
  mesh.points.col(control) *= 1.01;
  mesh.points.col(control).array() += 0.01;
  judgement = judge<Dim>(sample.cage, mesh, good);
  EXPECT_EQ(judgement.boundary_vertices_off_cage, 1);
  EXPECT_EQ(judgement.control_points_found, sample.cage.size() - 1);
  EXPECT_THROW(judge<Dim>(sample.cage, mesh, good.topRows(2)), std::invalid_argument);
}

TEST_IN_2D_AND_3D(SupportTest, ObjectiveOfBarycentricCoordinatesFollowsFromTheFacets) {
  const auto sample = make_sample<Dim>(Shape::kSimplex, 3, 0.2);
  MatrixXd phi(Dim + 1, sample.mesh.num_cells());
  double expected = 0;  // A |grad w_i| is the facet opposite to c_i over Dim
  for (Index i = 0; i <= Dim; ++i) {
    phi.row(i).setConstant(0.1 + i);
    PointList<Dim> facet(Dim, Dim);
    for (Index k = 0, slot = 0; k <= Dim; ++k) {
      if (k != i) facet.col(slot++) = sample.cage.points.col(k);
    }
    expected += (0.1 + i) * simplex_measure<Dim>(facet) / Dim;
  }
  EXPECT_NEAR(testing::objective(sample.mesh, harmonic_weights(sample), phi), expected, 1e-12);
}

TEST_IN_2D_AND_3D(SupportTest, MeanSquaredDifferenceCountsInteriorVerticesOnly) {
  const auto sample = make_sample<Dim>(Shape::kBox, 3);  // 2^Dim interior vertices
  const auto interior = interior_vertices(sample.mesh);
  const MatrixXd a = MatrixXd::Random(sample.cage.size(), sample.mesh.num_vertices());
  MatrixXd b = a;
  for (Index v = 0; v < sample.mesh.num_vertices(); ++v) {
    if (!interior[v]) b.col(v).array() += 7;
  }
  EXPECT_EQ(mean_squared_difference(sample.mesh, a, b), 0);
  const auto v = std::find(interior.begin(), interior.end(), true) - interior.begin();
  b(2, v) += 0.1;
  EXPECT_NEAR(mean_squared_difference(sample.mesh, a, b), 0.01 / std::pow(4, Dim), 1e-15);
  const auto no_interior = make_sample<Dim>(Shape::kBox, 1);
  EXPECT_THROW(mean_squared_difference(no_interior.mesh, a, b), std::invalid_argument);
}

}  // namespace
}  // namespace flbc::testing
