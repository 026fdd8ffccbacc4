// SPDX-License-Identifier: BSD-3-Clause
// Weights of a square cage, and the vertices of its mesh before and after a corner moves:
// lines "x y new_x new_y". Needs the core and flbc::cgal only.
#include <iostream>

#include <flbc/flbc.h>

int main() try {
  flbc::Cage<2> cage;
  cage.points = flbc::PointList<2>{{0, 1, 1, 0}, {0, 0, 1, 1}};  // x and y of the corners
  cage.facets = flbc::FacetList<2>{{0, 1, 2, 3}, {1, 2, 3, 0}};  // edges from a corner to the next

  const flbc::DomainMesh<2> mesh = flbc::triangulate(cage, {500});
  const flbc::Solution solution = flbc::solve(cage, mesh);

  flbc::PointList<2> pose = cage.points;
  pose.col(2) << 1.5, 1.5;
  const Eigen::MatrixXd moved = flbc::deform(solution.weights, pose);
  for (Eigen::Index v = 0; v < moved.cols(); ++v) {
    std::cout << mesh.points.col(v).transpose() << ' ' << moved.col(v).transpose() << '\n';
  }
  return 0;
} catch (const flbc::Error& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
