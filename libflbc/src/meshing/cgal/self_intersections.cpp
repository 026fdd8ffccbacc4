// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>

#include "base/messages.h"
#include "cage/box_tree.h"
#include "flbc/meshing.h"
#include "meshing/cgal/exact_predicates.h"

namespace flbc {

namespace {

// Compiles faster than the kernel that computes exactly only when it must. Few pairs are described.
using ExactKernel = CGAL::Simple_cartesian<CGAL::Exact_rational>;
using FacetPair = std::pair<Index, Index>;

template <int Dim>
std::vector<FacetPair> find_pairs(const Cage<Dim>& cage) {
  std::vector<FacetPair> pairs;
  for (const auto& [f, g] : close_pairs(boxes_of<Dim, Dim>(cage.points, cage.facets), 0)) {
    if (intersect_improperly<Dim>(cage.points, cage.facets.col(f), cage.facets.col(g))) {
      pairs.emplace_back(f, g);
    }
  }
  return pairs;
}

// A control point of one edge that lies on the other edge and is not shared; -1: none.
Index vertex_on_other_edge(const Cage<2>& cage, Index e, Index f) {
  for (const auto& [own, other] : {FacetPair{e, f}, FacetPair{f, e}}) {
    const Simplex<2> edge{cage.points(Eigen::all, cage.facets.col(other))};
    for (const Index vertex : cage.facets.col(own)) {
      if (vertex == cage.facets(0, other) || vertex == cage.facets(1, other)) continue;
      if (intersect<2>({cage.points.col(vertex).replicate(1, 2), 1}, edge)) return vertex;
    }
  }
  return -1;
}

// The intersection of two crossing edges without a vertex on each other, accurate to rounding.
Vector<2> crossing(const Cage<2>& cage, Index e, Index f) {
  const Vector<2> a = cage.points.col(cage.facets(0, e));
  const Vector<2> along_e = cage.points.col(cage.facets(1, e)) - a;
  const Vector<2> c = cage.points.col(cage.facets(0, f));
  const Vector<2> along_f = cage.points.col(cage.facets(1, f)) - c;
  const auto cross = [](const Vector<2>& u, const Vector<2>& v) {
    return u.x() * v.y() - u.y() * v.x();
  };
  const double determinant = cross(along_e, along_f);
  const double t = determinant != 0 ? cross(c - a, along_f) / determinant : 0.5;
  return a + std::clamp(t, 0.0, 1.0) * along_e;
}

Defect describe_pair(const Cage<2>& cage, const FacetPair& pair) {
  const auto [e, f] = pair;
  const Index vertex = vertex_on_other_edge(cage, e, f);
  if (vertex < 0) {
    return {"edges " + std::to_string(e) + " and " + std::to_string(f) +
                " of the cage cross near " + format_point(crossing(cage, e, f)),
            {},
            {e, f},
            DefectKind::kSelfIntersection};
  }
  const bool is_of_e = vertex == cage.facets(0, e) || vertex == cage.facets(1, e);
  const std::string touched = std::to_string(is_of_e ? f : e),
                    own = std::to_string(is_of_e ? e : f);
  return {describe_control_point<2>(cage.points, vertex) + ", an end of edge " + own +
              ", is on edge " + touched + ": the cage touches itself there",
          {vertex},
          {e, f},
          DefectKind::kSelfIntersection};
}

ExactKernel::Triangle_3 exact_triangle(const Cage<3>& cage, Index triangle) {
  const auto corner = [&](int k) {
    const auto p = cage.points.col(cage.facets(k, triangle));
    return ExactKernel::Point_3(p.x(), p.y(), p.z());
  };
  return {corner(0), corner(1), corner(2)};
}

// The center of the intersection of two triangles, which may be a point, segment, or polygon.
struct Middle {
  CGAL::Bbox_3 box;
  void operator()(const ExactKernel::Point_3& p) { box = p.bbox(); }
  void operator()(const ExactKernel::Segment_3& s) { box = s.bbox(); }
  void operator()(const ExactKernel::Triangle_3& t) { box = t.bbox(); }
  void operator()(const std::vector<ExactKernel::Point_3>& polygon) {
    for (const auto& p : polygon) box += p.bbox();
  }
  Vector<3> place() const {
    return {(box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2,
            (box.zmin() + box.zmax()) / 2};
  }
};

Defect describe_pair(const Cage<3>& cage, const FacetPair& pair) {
  const auto [s, t] = pair;
  std::string text =
      "triangles " + std::to_string(s) + " and " + std::to_string(t) + " of the cage intersect";
  if (const auto common = CGAL::intersection(exact_triangle(cage, s), exact_triangle(cage, t))) {
    Middle middle;
    boost::apply_visitor([&](const auto& shape) { middle(shape); }, *common);
    text += " near " + format_point(middle.place());
  }
  return {text, {}, {s, t}, DefectKind::kSelfIntersection};
}

}  // namespace

template <int Dim>
std::vector<Defect> find_self_intersections(const Cage<Dim>& cage, std::size_t limit) {
  std::vector<FacetPair> pairs = find_pairs(cage);
  if (pairs.size() > limit) pairs.resize(limit);
  std::vector<Defect> defects;
  defects.reserve(pairs.size());
  for (const FacetPair& pair : pairs) defects.push_back(describe_pair(cage, pair));
  return defects;
}

template std::vector<Defect> find_self_intersections<2>(const Cage<2>&, std::size_t);
template std::vector<Defect> find_self_intersections<3>(const Cage<3>&, std::size_t);

}  // namespace flbc
