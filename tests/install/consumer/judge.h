// SPDX-License-Identifier: BSD-3-Clause
// What every program here checks of the weights it got.
#pragma once

#include <iostream>

#include <flbc/flbc.h>

// Exit status of a program: 0 if weights (n x P) of points are coordinates without negative ones.
template <int Dim>
int judge(const flbc::Cage<Dim>& cage, const flbc::PointList<Dim>& points,
          const Eigen::MatrixXd& weights) {
  const double sum = (weights.colwise().sum().array() - 1).abs().maxCoeff();
  const double reproduction = (cage.points * weights - points).cwiseAbs().maxCoeff();
  std::cout << "libflbc " << FLBC_VERSION << ": " << weights.cols() << " points, sum " << sum
            << ", reproduction " << reproduction << ", smallest weight " << weights.minCoeff()
            << '\n';
  return sum < 1e-9 && reproduction < 1e-9 && weights.minCoeff() >= 0 ? 0 : 1;
}

// The unit square.
inline flbc::Cage<2> square() {
  return {flbc::PointList<2>{{0, 1, 1, 0}, {0, 0, 1, 1}},
          flbc::FacetList<2>{{0, 1, 2, 3}, {1, 2, 3, 0}}};
}

inline flbc::Cage<3> octahedron() {
  return {flbc::PointList<3>{{1, 0, 0, -1, 0, 0}, {0, 1, 0, 0, -1, 0}, {0, 0, 1, 0, 0, -1}},
          flbc::FacetList<3>{
              {0, 1, 3, 4, 1, 3, 4, 0}, {1, 3, 4, 0, 0, 1, 3, 4}, {2, 2, 2, 2, 5, 5, 5, 5}}};
}
