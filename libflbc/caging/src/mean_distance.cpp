// SPDX-License-Identifier: BSD-3-Clause
#include "caging/mean_distance.h"

#include <vector>

#include "caging/surface_tools.h"

namespace flbc {

namespace {

// Coordinates in a facet of the centres of equal pieces.
template <int Dim>
std::vector<Vector<Dim>> spread_coordinates() {
  constexpr int kPieces = 8;
  std::vector<Vector<Dim>> all;
  for (int i = 0; i < kPieces; ++i) {
    if constexpr (Dim == 2) {
      const double t = (i + 0.5) / kPieces;
      all.push_back({t, 1 - t});
    } else {
      for (int j = 0; i + j < kPieces; ++j) {
        const double s = (i + 1.0 / 3) / kPieces, t = (j + 1.0 / 3) / kPieces;
        all.push_back({s, t, 1 - s - t});
      }
    }
  }
  return all;
}

}  // namespace

template <int Dim>
double mean_distance(const Cage<Dim>& cage, const Enclosure<Dim>& model) {
  const auto coordinates = spread_coordinates<Dim>();
  const double farthest = 8 * model.box().diagonal().norm();
  double sum = 0, total = 0;
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    Eigen::Matrix<double, Dim, Dim> corners;
    for (int k = 0; k < Dim; ++k) corners.col(k) = cage.points.col(cage.facets(k, f));
    const double part = facet_normal<Dim>(corners).norm() / static_cast<double>(coordinates.size());
    for (const auto& weights : coordinates) {
      sum += part * model.distance(corners * weights, farthest);
      total += part;
    }
  }
  return sum / total;
}

template double mean_distance(const Cage<2>&, const Enclosure<2>&);
template double mean_distance(const Cage<3>&, const Enclosure<3>&);

}  // namespace flbc
