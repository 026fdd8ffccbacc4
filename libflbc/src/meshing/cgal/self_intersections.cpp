// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <utility>
#include <vector>

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>

#include "base/messages.h"
#include "cage/box_tree.h"
#include "flbc/meshing.h"
#include "meshing/cgal/exact_predicates.h"
#include "meshing/cgal/intersection.h"

namespace flbc {

namespace {

// Compiles faster than the kernel that computes exactly only when it must. Few pairs are described.
using ExactKernel = CGAL::Simple_cartesian<CGAL::Exact_rational>;
using FacetPair = std::pair<Index, Index>;

template <int Dim>
std::vector<FacetPair> find_pairs(const Cage<Dim>& cage, std::size_t limit) {
  const auto boxes = boxes_of<Dim, Dim>(cage.points, cage.facets);
  const BoxTree<Dim> tree(boxes);
  std::vector<FacetPair> pairs;
  std::vector<Index> close;
  for (Index f = 0; f < cage.facets.cols() && pairs.size() < limit; ++f) {
    close.clear();
    tree.any_of(boxes[f], [&](Index g) {
      if (g > f) close.push_back(g);
      return false;
    });
    std::sort(close.begin(), close.end());
    for (const Index g : close) {
      if (!intersect_improperly<Dim>(cage.points, cage.facets.col(f), cage.facets.col(g))) continue;
      pairs.emplace_back(f, g);
      if (pairs.size() == limit) break;
    }
  }
  return pairs;
}

template <int Dim>
auto exact_facet(const Cage<Dim>& cage, Index facet) {
  const auto corner = [&](int k) {
    const auto p = cage.points.col(cage.facets(k, facet));
    if constexpr (Dim == 2) {
      return ExactKernel::Point_2(p.x(), p.y());
    } else {
      return ExactKernel::Point_3(p.x(), p.y(), p.z());
    }
  };
  if constexpr (Dim == 2) {
    return ExactKernel::Segment_2(corner(0), corner(1));
  } else {
    return ExactKernel::Triangle_3(corner(0), corner(1), corner(2));
  }
}

// The center of an intersection.
template <int Dim>
struct Middle {
  template <class Shape>
  Vector<Dim> operator()(const Shape& shape) const {
    return of_box(shape.bbox());
  }
  Vector<Dim> operator()(const std::vector<ExactKernel::Point_3>& polygon) const {
    return of_box(CGAL::bbox_3(polygon.begin(), polygon.end()));
  }

  template <class Box>
  static Vector<Dim> of_box(const Box& box) {
    Vector<Dim> place;
    for (int k = 0; k < Dim; ++k) place[k] = ((box.min)(k) + (box.max)(k)) / 2;
    return place;
  }
};

template <int Dim>
Defect describe_pair(const Cage<Dim>& cage, const FacetPair& pair) {
  const auto [f, g] = pair;
  std::string text = std::string(Dim == 2 ? "edges " : "triangles ") + std::to_string(f) + " and " +
                     std::to_string(g) + " of the cage " +
                     (Dim == 2 ? "cross or touch" : "intersect");
  if (const auto common = CGAL::intersection(exact_facet(cage, f), exact_facet(cage, g))) {
    const auto middle = [](const auto& shape) -> Vector<Dim> { return Middle<Dim>()(shape); };
    text += " near " + format_point(visit_shape(middle, *common));
  }
  return {text, {}, {f, g}, DefectKind::kSelfIntersection};
}

}  // namespace

template <int Dim>
std::vector<Defect> find_self_intersections(const Cage<Dim>& cage, std::size_t limit) {
  const std::vector<FacetPair> pairs = find_pairs(cage, limit);
  std::vector<Defect> defects;
  defects.reserve(pairs.size());
  for (const FacetPair& pair : pairs) defects.push_back(describe_pair(cage, pair));
  return defects;
}

template std::vector<Defect> find_self_intersections<2>(const Cage<2>&, std::size_t);
template std::vector<Defect> find_self_intersections<3>(const Cage<3>&, std::size_t);

}  // namespace flbc
