// SPDX-License-Identifier: BSD-3-Clause
// The README's example, so that it stays true.
#include <flbc/flbc.h>

#include <gtest/gtest.h>

TEST(Readme, Example) {
  flbc::Cage<2> cage;
  cage.points.resize(2, 4);
  cage.points << 0, 1, 1, 0,  //
      0, 0, 1, 1;
  cage.facets.resize(2, 4);
  cage.facets << 0, 1, 2, 3,  //
      1, 2, 3, 0;

  flbc::DomainMesh<2> mesh = flbc::triangulate(cage, {500});  // component cgal; or your own mesh
  flbc::Solution solution = flbc::solve(cage, mesh);          // n x V, a column per vertex
  Eigen::MatrixXd moved = cage.points * solution.weights;  // = mesh.points: move cage.points

  EXPECT_LT((moved - mesh.points).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_NEAR(mesh.num_vertices(), 500, 25);
}
