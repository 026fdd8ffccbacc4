// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>

#include "base/messages.h"
#include "flbc/errors.h"
#include "flbc/meshing.h"

namespace flbc {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using FacetPair = std::pair<Index, Index>;

// ---------------------------------------------------------------------------------------------- 2D

Kernel::Point_2 point(const Cage<2>& cage, Index vertex) {
  return {cage.points(0, vertex), cage.points(1, vertex)};
}

Kernel::Segment_2 segment(const Cage<2>& cage, Index edge) {
  return {point(cage, cage.facets(0, edge)), point(cage, cage.facets(1, edge))};
}

// A control point of one edge that lies on the other edge and is not shared; -1: none.
Index vertex_on_other_edge(const Cage<2>& cage, Index e, Index f) {
  for (const auto& [own, other] : {FacetPair{e, f}, FacetPair{f, e}}) {
    for (int k = 0; k < 2; ++k) {
      const Index vertex = cage.facets(k, own);
      if (vertex == cage.facets(0, other) || vertex == cage.facets(1, other)) continue;
      if (segment(cage, other).has_on(point(cage, vertex))) return vertex;
    }
  }
  return -1;
}

// Edges with a common vertex intersect elsewhere only if one folds back along the other.
bool intersect(const Cage<2>& cage, Index e, Index f) {
  const auto a = cage.facets.col(e), b = cage.facets.col(f);
  const bool share_a_vertex =
      (a.array() == b.array()).any() || (a.array() == b.reverse().array()).any();
  if (share_a_vertex) return vertex_on_other_edge(cage, e, f) >= 0;
  return CGAL::do_intersect(segment(cage, e), segment(cage, f));
}

std::vector<FacetPair> find_pairs(const Cage<2>& cage) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, Index>;
  std::vector<Box> boxes;
  boxes.reserve(static_cast<std::size_t>(cage.facets.cols()));
  for (Index edge = 0; edge < cage.facets.cols(); ++edge) {
    boxes.emplace_back(segment(cage, edge).bbox(), edge);
  }
  std::vector<FacetPair> pairs;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    const FacetPair pair = std::minmax(a.info(), b.info());
    if (intersect(cage, pair.first, pair.second)) pairs.push_back(pair);
  });
  return pairs;
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

// ---------------------------------------------------------------------------------------------- 3D

std::vector<FacetPair> find_pairs(const Cage<3>& cage) {
  using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
  Surface surface;
  std::vector<Surface::Vertex_index> vertices;
  for (Index i = 0; i < cage.size(); ++i) {
    const auto p = cage.points.col(i);
    vertices.push_back(surface.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z())));
  }
  for (Index triangle = 0; triangle < cage.facets.cols(); ++triangle) {
    const auto corners = cage.facets.col(triangle);
    const auto face =
        surface.add_face(vertices[corners(0)], vertices[corners(1)], vertices[corners(2)]);
    if (face == Surface::null_face()) {
      throw InputError("triangle " + std::to_string(triangle) +
                       " of the cage does not fit its neighbors: the surface is not manifold");
    }
  }
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> faces;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(faces));
  std::vector<FacetPair> pairs;
  pairs.reserve(faces.size());
  for (const auto& [a, b] : faces) {
    pairs.push_back(
        std::minmax(static_cast<Index>(std::size_t(a)), static_cast<Index>(std::size_t(b))));
  }
  return pairs;
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
  std::sort(pairs.begin(), pairs.end());
  if (pairs.size() > limit) pairs.resize(limit);
  std::vector<Defect> defects;
  defects.reserve(pairs.size());
  for (const FacetPair& pair : pairs) defects.push_back(describe_pair(cage, pair));
  return defects;
}

template std::vector<Defect> find_self_intersections<2>(const Cage<2>&, std::size_t);
template std::vector<Defect> find_self_intersections<3>(const Cage<3>&, std::size_t);

}  // namespace flbc
