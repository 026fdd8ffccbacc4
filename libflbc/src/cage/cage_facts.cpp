// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/cage_facts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/messages.h"
#include "cage/facet_distance.h"
#include "cage/oriented_cage.h"
#include "cage/point_in_cage.h"
#include "flbc/boundary_tolerance.h"
#include "flbc/bounding_box.h"

namespace flbc {

template <int Dim>
std::vector<Defect> find_separate_parts(const Cage<Dim>& cage) {
  const OrientedCage<Dim> oriented = orient(cage);
  std::vector<Index> first_points;  // of the outer shells
  std::vector<char> is_seen(oriented.is_hole.size(), 0);
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    const Index shell = oriented.shell_of_facet[f];
    if (is_seen[shell] || oriented.is_hole[shell]) continue;
    is_seen[shell] = 1;
    first_points.push_back(cage.facets(0, f));
  }
  if (first_points.size() < 2) return {};
  return {{"the interior is not connected: it has " + std::to_string(first_points.size()) +
               " parts, one with " + describe_control_point<Dim>(cage.points, first_points[0]) +
               ", one with " + describe_control_point<Dim>(cage.points, first_points[1]) +
               "; give each part a file of its own",
           {first_points[0], first_points[1]}}};
}

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

#define FLBC_INSTANTIATE(Dim)                             \
  template CageFacts<Dim> measure_cage(const Cage<Dim>&); \
  template ThinPlace thinnest_place(const Cage<Dim>&);    \
  template std::vector<Defect> find_separate_parts(const Cage<Dim>&); \
  template std::vector<Index> points_outside(const Cage<Dim>&, const PointList<Dim>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
