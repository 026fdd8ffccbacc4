// SPDX-License-Identifier: BSD-3-Clause
#include "caging/cage_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/instantiate.h"

namespace flbc {

template <int Dim>
Cage<Dim> simplified(const PointList<Dim>& points, const FacetList<Dim>& facets, double cell) {
  const auto size = static_cast<std::size_t>(points.cols());
  std::vector<std::array<long, Dim>> cells(size);
  const Vector<Dim> low = points.rowwise().minCoeff();
  for (std::size_t v = 0; v < size; ++v) {
    for (int k = 0; k < Dim; ++k) {
      cells[v][k] = static_cast<long>(std::floor((points(k, v) - low(k)) / cell));
    }
  }
  std::vector<Index> order(size), merged(size);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return cells[a] != cells[b] ? cells[a] < cells[b] : a < b; });
  Cage<Dim> result{PointList<Dim>(Dim, points.cols()), {}};
  Index count = 0;
  for (std::size_t k = 0; k < size; ++count) {
    const auto begin = k;
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (; k < size && cells[order[k]] == cells[order[begin]]; ++k) {
      sum += points.col(order[k]);
      merged[order[k]] = count;
    }
    result.points.col(count) = sum / static_cast<double>(k - begin);
  }
  result.points.conservativeResize(Dim, count);
  std::vector<std::array<Index, Dim>> corners;
  for (Index f = 0; f < facets.cols(); ++f) {
    std::array<Index, Dim> facet;
    for (int k = 0; k < Dim; ++k) facet[k] = merged[facets(k, f)];
    if (std::all_of(facet.begin(), facet.end(), [&](Index v) { return v == facet[0]; })) continue;
    // Rotated, not sorted, so that the orientation remains.
    std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
    corners.push_back(facet);
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  result.facets.resize(Dim, static_cast<Eigen::Index>(corners.size()));
  for (std::size_t f = 0; f < corners.size(); ++f) {
    for (int k = 0; k < Dim; ++k) result.facets(k, f) = corners[f][k];
  }
  return result;
}

FLBC_INSTANTIATE_FUNCTION(simplified)

}  // namespace flbc
