// SPDX-License-Identifier: BSD-3-Clause
// Checks of how the facets of a cage meet.
#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "base/messages.h"
#include "base/union_find.h"
#include "cage/cage_defects.h"

namespace flbc {

namespace {

// A triangle that has an edge, and whether it runs along it from the smaller to the larger index.
struct Incidence {
  Index triangle;
  bool is_forward;
};

// Ordered, so that the defects come out in the same order everywhere.
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

std::string describe_edge(const Cage<3>& cage, Index from, Index to) {
  return describe_control_point<3>(cage.points, from) + " and " +
         describe_control_point<3>(cage.points, to);
}

void check_edge(const Cage<3>& cage, const std::pair<Index, Index>& ends,
                const std::vector<Incidence>& incidences, DefectList& found) {
  const auto [a, b] = ends;
  std::vector<Index> triangles;
  triangles.reserve(incidences.size());
  for (const Incidence& incidence : incidences) triangles.push_back(incidence.triangle);

  if (incidences.size() == 1) {
    found.add({"the cage is open at the edge between " + describe_edge(cage, a, b) + ": triangle " +
                   std::to_string(triangles[0]) + " has no neighbour there",
               {a, b},
               triangles});
  } else if (incidences.size() > 2) {
    found.add({"the edge between " + describe_edge(cage, a, b) + " is non-manifold: triangles " +
                   describe_list(triangles) + " share it, where two must",
               {a, b},
               triangles});
  } else if (incidences[0].is_forward == incidences[1].is_forward) {
    found.add({"triangles " + describe_list(triangles) +
                   " are oriented inconsistently: both run in the same direction along the edge "
                   "between " +
                   describe_edge(cage, a, b) + "; reverse one of them",
               {a, b},
               triangles});
  }
}

// Triangles that share an edge at a vertex are of one fan; two cones that touch in their tips are
// two.
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
    found.add({"the cage is non-manifold at " + describe_control_point<3>(cage.points, vertex) +
                   ": the triangles there form " + std::to_string(triangles.size()) +
                   " separate fans (round triangles " + describe_list(triangles) +
                   "), where they must form one",
               {vertex},
               triangles});
  }
}

}  // namespace

void check_connections(const Cage<2>& cage, DefectList& found) {
  std::vector<std::vector<Index>> edges_at(static_cast<std::size_t>(cage.size()));
  for (Index edge = 0; edge < cage.facets.cols(); ++edge) {
    for (int k = 0; k < 2; ++k) edges_at[cage.facets(k, edge)].push_back(edge);
  }
  for (Index vertex = 0; vertex < cage.size() && !found.is_full(); ++vertex) {
    const std::vector<Index>& edges = edges_at[vertex];
    const std::string place = describe_control_point<2>(cage.points, vertex);
    if (edges.size() == 1) {
      found.add({"the cage is open at " + place + ": edge " + std::to_string(edges[0]) +
                     " ends there, where two edges must meet",
                 {vertex},
                 edges});
    } else if (edges.size() > 2) {
      found.add({"the cage branches at " + place + ": edges " + describe_list(edges) +
                     " meet there, where two must",
                 {vertex},
                 edges});
    }
  }
}

void check_connections(const Cage<3>& cage, DefectList& found) {
  const EdgeMap edges = collect_edges(cage);
  bool is_manifold = true;
  for (const auto& [ends, incidences] : edges) {
    if (found.is_full()) return;
    check_edge(cage, ends, incidences, found);
    is_manifold = is_manifold && incidences.size() == 2;
  }
  // Fans end at open edges and merge at non-manifold ones: those have been reported already.
  if (is_manifold) check_fans(cage, edges, found);
}

}  // namespace flbc
