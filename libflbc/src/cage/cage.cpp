// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/cage.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "base/instantiate.h"
#include "base/messages.h"
#include "base/union_find.h"
#include "cage/close_points.h"
#include "cage/extent.h"
#include "flbc/bounding_box.h"
#include "flbc/errors.h"
#include "linear/dense.h"

namespace flbc {
namespace {

// Collects defects up to a limit.
class DefectList {
 public:
  explicit DefectList(std::size_t limit) : limit_(limit) {}

  bool empty() const { return defects_.empty(); }
  bool is_full() const { return defects_.size() >= limit_; }
  void add(DefectKind kind, Defect defect) {
    defect.kind = kind;
    if (!is_full()) defects_.push_back(std::move(defect));
  }
  std::vector<Defect> take() { return std::move(defects_); }

 private:
  std::size_t limit_;
  std::vector<Defect> defects_;
};

// A length below this fraction of cage size counts as zero.
constexpr double kRelativeTolerance = 1e-10;

template <int Dim>
std::string facet_name() {
  return Dim == 2 ? "edge" : "triangle";
}

template <int Dim>
void check_counts(const Cage<Dim>& cage, DefectList& found) {
  const std::string least = std::to_string(Dim + 1);
  if (cage.size() < Dim + 1) {
    found.add(DefectKind::kCount, {"the cage has " + std::to_string(cage.size()) +
                                   " control points; at least " + least + " are needed"});
  }
  if (cage.facets.cols() < Dim + 1) {
    found.add(DefectKind::kCount, {"the cage has " + std::to_string(cage.facets.cols()) + " " +
                                   facet_name<Dim>() + "s; at least " + least + " are needed"});
  }
}

template <int Dim>
void check_finiteness(const Cage<Dim>& cage, DefectList& found) {
  for (Index vertex = 0; vertex < cage.size() && !found.is_full(); ++vertex) {
    if (cage.points.col(vertex).allFinite()) continue;
    found.add(DefectKind::kNonFinite,
              {describe_control_point<Dim>(cage.points, vertex) + " is not finite", {vertex}});
  }
}

template <int Dim>
void check_extent(const Cage<Dim>& cage, DefectList& found) {
  if (cage.size() == 0 || !cage.points.allFinite()) return;
  // Points in one place are reported as coincident.
  if (!(bounding_box_diagonal<Dim>(cage.points) > 0)) return;
  const auto text = extent_defect<Dim>(cage.points, "cage", "control point 0");
  if (!text.empty()) found.add(DefectKind::kExtent, {text});
}

template <int Dim>
void check_indices(const Cage<Dim>& cage, DefectList& found) {
  for (Index facet = 0; facet < cage.facets.cols() && !found.is_full(); ++facet) {
    const std::string name = facet_name<Dim>() + " " + std::to_string(facet);
    for (int k = 0; k < Dim; ++k) {
      const Index vertex = cage.facets(k, facet);
      if (vertex < 0 || vertex >= cage.size()) {
        found.add(DefectKind::kIndex, {name + " refers to control point " + std::to_string(vertex) +
                                           ", but control points are numbered from 0 to " +
                                           std::to_string(cage.size() - 1),
                                       {},
                                       {facet}});
        break;
      }
      if (vertex == cage.facets((k + 1) % Dim, facet)) {
        found.add(DefectKind::kIndex,
                  {name + " names " + describe_control_point<Dim>(cage.points, vertex) + " twice",
                   {vertex},
                   {facet}});
        break;
      }
    }
  }
}

template <int Dim>
void check_coincidence(const Cage<Dim>& cage, DefectList& found) {
  const double tolerance = kRelativeTolerance * bounding_box_diagonal<Dim>(cage.points);
  for (const auto& pair : find_close_pairs<Dim>(cage.points, tolerance, cage.size())) {
    if (found.is_full()) return;
    found.add(DefectKind::kCoincident,
              {"control points " + std::to_string(pair[0]) + " and " + std::to_string(pair[1]) +
                   " coincide at " + format_point(cage.points.col(pair[0])) +
                   ": the cage is not welded there; merge them into one",
               {pair[0], pair[1]}});
  }
}

template <int Dim>
void check_references(const Cage<Dim>& cage, DefectList& found) {
  std::vector<bool> is_used(static_cast<std::size_t>(cage.size()), false);
  for (Index facet = 0; facet < cage.facets.cols(); ++facet) {
    for (int k = 0; k < Dim; ++k) is_used[cage.facets(k, facet)] = true;
  }
  for (Index vertex = 0; vertex < cage.size() && !found.is_full(); ++vertex) {
    if (is_used[vertex]) continue;
    found.add(DefectKind::kUnreferenced,
              {describe_control_point<Dim>(cage.points, vertex) + " belongs to no " +
                   facet_name<Dim>() + "; remove it or connect it",
               {vertex}});
  }
}

// A cage with an open slit may pass all checks of elements and still enclose nothing.
template <int Dim>
void check_flatness(const Cage<Dim>& cage, DefectList& found) {
  const PointList<Dim> centred = cage.points.colwise() - cage.points.rowwise().mean().eval();
  const double thickness = dense::least_pivot(centred.transpose()) / std::sqrt(double(cage.size()));
  if (thickness > kRelativeTolerance * bounding_box_diagonal<Dim>(cage.points)) return;
  found.add(DefectKind::kFlat, {std::string("all control points are in one ") +
                                (Dim == 2 ? "line" : "plane") + ", so the cage encloses nothing"});
}

// The smallest altitude, which is the length of an edge in 2D.
template <int Dim>
double smallest_altitude(const Cage<Dim>& cage, Index facet) {
  const Vector<Dim> a = cage.points.col(cage.facets(0, facet));
  const Vector<Dim> b = cage.points.col(cage.facets(1, facet));
  if constexpr (Dim == 2) {
    return (b - a).norm();
  } else {
    const Vector<3> c = cage.points.col(cage.facets(2, facet));
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    return longest > 0 ? (b - a).cross(c - a).norm() / longest : 0.0;
  }
}

template <int Dim>
void check_measures(const Cage<Dim>& cage, DefectList& found) {
  const double tolerance = kRelativeTolerance * bounding_box_diagonal<Dim>(cage.points);
  for (Index facet = 0; facet < cage.facets.cols() && !found.is_full(); ++facet) {
    if (smallest_altitude(cage, facet) > tolerance) continue;
    const auto corners = cage.facets.col(facet);
    std::string text = facet_name<Dim>() + " " + std::to_string(facet) +
                       (Dim == 2 ? " has no length: it joins " : " is degenerate: its corners, ");
    for (int k = 0; k < Dim; ++k) {
      if (k > 0) text += k + 1 < Dim ? ", " : " and ";
      text += describe_control_point<Dim>(cage.points, corners(k));
    }
    if (Dim == 3) text += ", are on one line";
    found.add(DefectKind::kDegenerate,
              {text, std::vector<Index>(corners.data(), corners.data() + Dim), {facet}});
  }
}

template <int Dim>
void check_repetition(const Cage<Dim>& cage, DefectList& found) {
  std::map<std::vector<Index>, Index> first_with;
  for (Index facet = 0; facet < cage.facets.cols() && !found.is_full(); ++facet) {
    const auto corners = cage.facets.col(facet);
    std::vector<Index> vertices(corners.begin(), corners.end());
    std::sort(vertices.begin(), vertices.end());
    const auto [entry, is_new] = first_with.emplace(vertices, facet);
    if (is_new) continue;
    found.add(DefectKind::kDuplicate,
              {facet_name<Dim>() + "s " + std::to_string(entry->second) + " and " +
                   std::to_string(facet) + " are the same: both join control points " +
                   describe_list(vertices) + ", the first of them at " +
                   format_point(cage.points.col(vertices[0])),
               vertices,
               {entry->second, facet}});
  }
}

// A triangle at an edge, and whether it traverses the edge from the smaller to the larger index.
struct Incidence {
  Index triangle;
  bool is_forward;
};

// Ordered, so the order of defects is reproducible.
using EdgeMap = std::map<std::pair<Index, Index>, std::vector<Incidence>>;

EdgeMap collect_edges(const Cage<3>& cage) {
  EdgeMap edges;
  for (Index triangle = 0; triangle < cage.facets.cols(); ++triangle) {
    for (int k = 0; k < 3; ++k) {
      const Index from = cage.facets(k, triangle), to = cage.facets((k + 1) % 3, triangle);
      edges[std::minmax(from, to)].push_back({triangle, from < to});
    }
  }
  return edges;
}

void check_edge(const Cage<3>& cage, const std::pair<Index, Index>& ends,
                const std::vector<Incidence>& incidences, DefectList& found) {
  if (incidences.size() == 2 && incidences[0].is_forward != incidences[1].is_forward) return;
  const auto [a, b] = ends;
  std::vector<Index> triangles;
  triangles.reserve(incidences.size());
  for (const Incidence& incidence : incidences) triangles.push_back(incidence.triangle);
  const std::string place = describe_control_point<3>(cage.points, a) + " and " +
                            describe_control_point<3>(cage.points, b);
  std::string text;
  auto kind = DefectKind::kOrientation;
  if (incidences.size() == 1) {
    kind = DefectKind::kOpen;
    text = "the cage is open at the edge between " + place + ": triangle " +
           std::to_string(triangles[0]) + " has no neighbor there";
  } else if (incidences.size() > 2) {
    kind = DefectKind::kNonManifold;
    text = "the edge between " + place + " is non-manifold: triangles " + describe_list(triangles) +
           " share it; exactly two must";
  } else {
    text = "triangles " + describe_list(triangles) +
           " are oriented inconsistently: both run in the same direction along the edge between " +
           place + "; reverse one of them";
  }
  found.add(kind, {text, {a, b}, triangles});
}

// Triangles that share an edge at a vertex belong to one fan; two cones that touch at their tips
// are two fans.
void check_fans(const Cage<3>& cage, const EdgeMap& edges, DefectList& found) {
  UnionFind fans(static_cast<Index>(3 * cage.facets.cols()));  // corner k of triangle t: 3 t + k
  const auto corner = [&](Index triangle, Index vertex) {
    int k = 0;
    while (cage.facets(k, triangle) != vertex) ++k;
    return 3 * triangle + k;
  };
  for (const auto& [ends, incidences] : edges) {
    for (const Incidence& incidence : incidences) {
      const Index first = incidences.front().triangle;
      fans.unite(corner(first, ends.first), corner(incidence.triangle, ends.first));
      fans.unite(corner(first, ends.second), corner(incidence.triangle, ends.second));
    }
  }

  std::vector<std::vector<Index>> triangles_of_fan(static_cast<std::size_t>(cage.size()));
  for (Index triangle = 0; triangle < cage.facets.cols(); ++triangle) {
    for (int k = 0; k < 3; ++k) {
      if (fans.find(3 * triangle + k) == 3 * triangle + k) {
        triangles_of_fan[cage.facets(k, triangle)].push_back(triangle);
      }
    }
  }
  for (Index vertex = 0; vertex < cage.size() && !found.is_full(); ++vertex) {
    const std::vector<Index>& triangles = triangles_of_fan[vertex];
    if (triangles.size() <= 1) continue;
    found.add(DefectKind::kNonManifold,
              {"the cage is non-manifold at " + describe_control_point<3>(cage.points, vertex) +
                   ": the triangles there form " + std::to_string(triangles.size()) +
                   " separate fans (around triangles " + describe_list(triangles) +
                   "); they must form one",
               {vertex},
               triangles});
  }
}

// Checks how facets meet. 2D: two edges at each control point.
void check_connections(const Cage<2>& cage, DefectList& found) {
  std::vector<std::vector<Index>> edges_at(static_cast<std::size_t>(cage.size()));
  for (Index edge = 0; edge < cage.facets.cols(); ++edge) {
    for (int k = 0; k < 2; ++k) edges_at[cage.facets(k, edge)].push_back(edge);
  }
  for (Index vertex = 0; vertex < cage.size() && !found.is_full(); ++vertex) {
    const std::vector<Index>& edges = edges_at[vertex];
    const std::string place = describe_control_point<2>(cage.points, vertex);
    if (edges.size() == 1) {
      found.add(DefectKind::kOpen,
                {"the cage is open at " + place + ": edge " + std::to_string(edges[0]) +
                     " ends there; two edges must meet",
                 {vertex},
                 edges});
    } else if (edges.size() > 2) {
      found.add(DefectKind::kNonManifold,
                {"the cage branches at " + place + ": edges " + describe_list(edges) +
                     " meet there; exactly two must",
                 {vertex},
                 edges});
    }
  }
}

// 3D: two triangles at each edge, in opposite directions, and one fan of triangles around each
// control point.
void check_connections(const Cage<3>& cage, DefectList& found) {
  const EdgeMap edges = collect_edges(cage);
  bool is_manifold = true;
  for (const auto& [ends, incidences] : edges) {
    if (found.is_full()) return;
    check_edge(cage, ends, incidences, found);
    is_manifold = is_manifold && incidences.size() == 2;
  }
  // Fans end at open edges and merge at non-manifold edges, which have already been reported.
  if (is_manifold) check_fans(cage, edges, found);
}

}  // namespace

template <int Dim>
std::vector<Defect> find_defects(const Cage<Dim>& cage, std::size_t limit) {
  DefectList found(limit);
  check_counts(cage, found);
  check_finiteness(cage, found);
  check_extent(cage, found);
  check_indices(cage, found);
  if (!found.empty()) return found.take();  // the checks below need valid indices
  check_coincidence(cage, found);
  check_references(cage, found);
  check_flatness(cage, found);
  check_measures(cage, found);
  check_repetition(cage, found);
  check_connections(cage, found);
  return found.take();
}

template <int Dim>
void validate(const Cage<Dim>& cage) {
  const std::vector<Defect> defects = find_defects(cage, 1);
  if (!defects.empty()) throw InputError(defects.front().message);
}

template struct Cage<2>;
template struct Cage<3>;
FLBC_INSTANTIATE_FUNCTION(find_defects)
FLBC_INSTANTIATE_FUNCTION(validate)

}  // namespace flbc
