// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/cage_facts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "cage/box_tree.h"
#include "cage/oriented_cage.h"
#include "cage/point_in_cage.h"
#include "flbc/bounding_box.h"

namespace flbc {
namespace {

// The part of a cage with these facets.
template <int Dim>
CagePart<Dim> extract(const Cage<Dim>& cage, const std::vector<Index>& facets) {
  CagePart<Dim> part;
  std::vector<Index> number(cage.size(), -1);
  for (const Index f : facets) {
    for (const Index i : cage.facets.col(f)) number[i] = 0;
  }
  for (Index i = 0; i < cage.size(); ++i) {
    if (number[i] < 0) continue;
    number[i] = static_cast<Index>(part.control_points.size());
    part.control_points.push_back(i);
  }
  part.cage = {cage.points(Eigen::all, part.control_points), cage.facets(Eigen::all, facets)};
  for (Index& corner : part.cage.facets.reshaped()) corner = number[corner];
  return part;
}

// Which shells enclose which.
template <int Dim>
class Nesting {
 public:
  explicit Nesting(const OrientedCage<Dim>& oriented) {
    std::vector<std::vector<Index>> facets_of_shell(oriented.is_hole.size());
    for (std::size_t f = 0; f < oriented.shell_of_facet.size(); ++f) {
      facets_of_shell[oriented.shell_of_facet[f]].push_back(static_cast<Index>(f));
    }
    for (const auto& facets : facets_of_shell) {
      auto shell = extract(oriented.cage, facets).cage;
      corners_.push_back(shell.points.col(0));
      shells_.emplace_back(std::move(shell), 0);
    }
  }

  // Shells do not intersect, so one corner decides.
  bool encloses(std::size_t outer, std::size_t inner) const {
    return outer != inner && shells_[outer].locate(corners_[inner]) == Containment::kInside;
  }

 private:
  std::vector<CageLocator<Dim>> shells_;
  std::vector<Vector<Dim>> corners_;
};

// Per shell, the outer shell of its part: the shell itself, or the innermost shell around a hole.
template <int Dim>
std::vector<std::size_t> outer_shells(const OrientedCage<Dim>& oriented) {
  const Nesting<Dim> nesting(oriented);
  const auto num_shells = oriented.is_hole.size();
  std::vector<std::size_t> outer(num_shells);
  for (std::size_t shell = 0; shell < num_shells; ++shell) {
    outer[shell] = shell;
    if (!oriented.is_hole[shell]) continue;
    for (std::size_t other = 0; other < num_shells; ++other) {
      if (oriented.is_hole[other] || !nesting.encloses(other, shell)) continue;
      if (outer[shell] == shell || nesting.encloses(outer[shell], other)) outer[shell] = other;
    }
  }
  return outer;
}

// The distance of edges that pass each other between their ends. Infinite for others, because an
// end is nearest.
double passing_distance(const PointList<3>& points, Index a, Index b, Index c, Index d) {
  const Vector<3> first = points.col(b) - points.col(a), second = points.col(d) - points.col(c);
  const Vector<3> offset = points.col(c) - points.col(a), normal = first.cross(second);
  if (!(normal.norm() > 1e-9 * first.norm() * second.norm())) {
    return std::numeric_limits<double>::infinity();  // parallel
  }
  const double along_first = offset.cross(second).dot(normal) / normal.squaredNorm();
  const double along_second = offset.cross(first).dot(normal) / normal.squaredNorm();
  const bool pass = along_first > 0 && along_first < 1 && along_second > 0 && along_second < 1;
  return pass ? std::abs(offset.dot(normal.normalized())) : std::numeric_limits<double>::infinity();
}

void compare_edges(const Cage<2>&, ThinPlace&) {
}

// Diagonals of neighboring sides of a box pass each other too, but not much closer than its
// corners.
// \param thinnest  of control points and facets
void compare_edges(const Cage<3>& cage, ThinPlace& thinnest) {
  FacetList<2> edges(2, 3 * cage.facets.cols());  // edge 3 f + k begins at corner k of facet f
  for (int k = 0; k < 3; ++k) {
    edges(0, Eigen::seqN(k, cage.facets.cols(), 3)) = cage.facets.row(k);
    edges(1, Eigen::seqN(k, cage.facets.cols(), 3)) = cage.facets.row((k + 1) % 3);
  }
  double limit = thinnest.distance / 2;
  const auto boxes = boxes_of<3, 2>(cage.points, edges);
  const BoxTree<3> tree(boxes);
  for (Index e = 0; e < edges.cols(); ++e) {
    const Index from = edges(0, e), to = edges(1, e);
    if (from > to) continue;  // the other facet has it too
    const Vector<3> margin = Vector<3>::Constant(limit);
    tree.any_of({boxes[e].min() - margin, boxes[e].max() + margin}, [&](Index other) {
      const auto facet = cage.facets.col(other / 3);
      const auto ends = edges.col(other);
      if ((facet.array() == from).any() || (ends.array() == to).any()) return false;
      const double distance = passing_distance(cage.points, from, to, ends(0), ends(1));
      if (distance < limit) thinnest = {limit = distance, from, other / 3};
      return false;
    });
  }
}

}  // namespace

template <int Dim>
ThinPlace thinnest_place(const Cage<Dim>& cage) {
  check_elements(cage.points, cage.facets, kCageNames);
  const BoxTree<Dim> tree(boxes_of<Dim, Dim>(cage.points, cage.facets));
  ThinPlace thinnest;
  thinnest.distance = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < cage.size(); ++i) {
    const Vector<Dim> point = cage.points.col(i);
    const auto distance_to = [&](Index f) {
      const auto facet = cage.facets.col(f);
      if ((facet.array() == i).any()) return std::numeric_limits<double>::infinity();
      return distance_to_facet<Dim>(point, cage.points(Eigen::all, facet));
    };
    const Index f = tree.nearest(point, distance_to, thinnest.distance);
    if (f < 0) continue;
    const double distance = distance_to(f);
    const bool is_tie = distance == thinnest.distance && f < thinnest.facet;
    if (distance < thinnest.distance || is_tie) thinnest = {distance, i, f};
  }
  compare_edges(cage, thinnest);
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
  std::vector<char> is_outside(num_points);  // not bool: neighbors are written concurrently
  parallel_for(num_points, [&](Index p) { is_outside[p] = locator.is_outside(points.col(p)); });
  std::vector<Index> outside;
  for (Index p = 0; p < num_points; ++p) {
    if (is_outside[p]) outside.push_back(p);
  }
  return outside;
}

template <int Dim>
std::vector<CagePart<Dim>> cage_parts(const Cage<Dim>& cage) {
  const auto oriented = orient(cage);
  const auto outer = outer_shells(oriented);
  std::vector<std::vector<Index>> facets_of_part(outer.size());  // by outer shell
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    facets_of_part[outer[oriented.shell_of_facet[f]]].push_back(f);
  }
  std::vector<CagePart<Dim>> parts;
  for (const auto& facets : facets_of_part) {
    if (!facets.empty()) parts.push_back(extract(cage, facets));
  }
  std::sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
    return a.control_points.front() < b.control_points.front();
  });
  return parts;
}

FLBC_INSTANTIATE_FUNCTION(measure_cage)
FLBC_INSTANTIATE_FUNCTION(thinnest_place)
FLBC_INSTANTIATE_FUNCTION(points_outside)
FLBC_INSTANTIATE_FUNCTION(cage_parts)

}  // namespace flbc
