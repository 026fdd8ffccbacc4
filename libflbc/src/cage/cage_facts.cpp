// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/cage_facts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/instantiate.h"
#include "cage/oriented_cage.h"
#include "cage/point_in_cage.h"
#include "flbc/bounding_box.h"

namespace flbc {

template <int Dim>
ThinPlace thinnest_place(const Cage<Dim>& cage) {
  ThinPlace thinnest;
  thinnest.distance = std::numeric_limits<double>::infinity();
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    Eigen::Matrix<double, Dim, Dim> corners;
    for (int k = 0; k < Dim; ++k) corners.col(k) = cage.points.col(cage.facets(k, f));
    const Vector<Dim> low = corners.rowwise().minCoeff();
    const Vector<Dim> high = corners.rowwise().maxCoeff();
    for (Index i = 0; i < cage.size(); ++i) {
      if ((cage.facets.col(f).array() == i).any()) continue;
      const Vector<Dim> point = cage.points.col(i);
      const Vector<Dim> beside = (low - point).cwiseMax(point - high).cwiseMax(0);
      if (beside.norm() >= thinnest.distance) continue;
      const double distance = distance_to_facet<Dim>(point, corners);
      if (distance < thinnest.distance) thinnest = {distance, i, f};
    }
  }
  return thinnest;
}

template <int Dim>
CageFacts<Dim> measure_cage(const Cage<Dim>& cage) {
  const auto oriented = orient(cage);
  CageFacts<Dim> facts;
  facts.holes =
      static_cast<Index>(std::count(oriented.is_hole.begin(), oriented.is_hole.end(), true));
  facts.parts = static_cast<Index>(oriented.is_hole.size()) - facts.holes;
  facts.size = bounding_box_diagonal(cage.points);
  facts.measure = oriented.measure;
  facts.shortest_edge = std::numeric_limits<double>::infinity();
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    for (int k = 0; k < (Dim == 2 ? 1 : 3); ++k) {
      const Index from = cage.facets(k, f);
      const Index to = cage.facets((k + 1) % Dim, f);
      const double length = (cage.points.col(from) - cage.points.col(to)).stableNorm();
      if (length >= facts.shortest_edge) continue;
      facts.shortest_edge = length;
      facts.shortest_ends[0] = std::min(from, to);
      facts.shortest_ends[1] = std::max(from, to);
    }
  }
  return facts;
}

template <int Dim>
std::vector<Index> points_outside(const Cage<Dim>& cage, const PointList<Dim>& points) {
  const CageLocator<Dim> locator(cage, kBoundaryTolerance * bounding_box_diagonal(cage.points));
  const auto num_points = static_cast<Index>(points.cols());
  std::vector<char> is_outside(num_points);  // not bool: neighbours are written at the same time
#pragma omp parallel for schedule(static)
  for (Index p = 0; p < num_points; ++p) {
    is_outside[p] = locator.locate(points.col(p)) == Containment::kOutside;
  }
  std::vector<Index> outside;
  for (Index p = 0; p < num_points; ++p) {
    if (is_outside[p]) outside.push_back(p);
  }
  return outside;
}

FLBC_INSTANTIATE_FUNCTION(measure_cage)
FLBC_INSTANTIATE_FUNCTION(thinnest_place)
FLBC_INSTANTIATE_FUNCTION(points_outside)

}  // namespace flbc
