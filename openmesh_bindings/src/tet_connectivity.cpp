// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/tet_connectivity.h"

#include <algorithm>
#include <string>
#include <utility>

#include "flbc/errors.h"

namespace flbc::openmesh {
namespace {

// The vertices of a cell's face opposite its k-th vertex, anticlockwise as seen from outside.
constexpr int kFaceCorners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

constexpr int kEdgeCorners[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

// The edges of the face opposite the k-th vertex, as rows of kEdgeCorners.
constexpr int kFaceEdges[4][3] = {{3, 4, 5}, {1, 2, 5}, {0, 2, 4}, {0, 1, 3}};

// Twice the number of a face or an edge has to be an int.
constexpr std::size_t kMaxCells = std::size_t{1} << 27;

std::array<int, 2> ascending(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

std::array<int, 3> ascending(int a, int b, int c) {
  if (a > b) std::swap(a, b);
  if (b > c) std::swap(b, c);
  if (a > b) std::swap(a, b);
  return {a, b, c};
}

std::array<int, 3> face_key(const std::array<int, 4>& vertices, int opposite) {
  const int* corners = kFaceCorners[opposite];
  return ascending(vertices[corners[0]], vertices[corners[1]], vertices[corners[2]]);
}

// Puts an entry, the newest, behind the last one of a closed list.
void append_to_list(std::vector<int>& next, int& last, int entry) {
  if (last < 0) {
    next.push_back(entry);
  } else {
    next.push_back(next[last]);
    next[last] = entry;
  }
  last = entry;
}

std::string describe(const std::array<int, 4>& v) {
  return "(" + std::to_string(v[0]) + ", " + std::to_string(v[1]) + ", " + std::to_string(v[2]) +
         ", " + std::to_string(v[3]) + ")";
}

void check_vertices(const std::array<int, 4>& vertices, std::size_t n_vertices, std::size_t cell) {
  const auto fail = [&](const std::string& defect) {
    throw InputError("cell " + std::to_string(cell) + " of the tetrahedral mesh, of vertices " +
                     describe(vertices) + ", " + defect);
  };
  for (int k = 0; k < 4; ++k) {
    if (vertices[k] < 0 || static_cast<std::size_t>(vertices[k]) >= n_vertices) {
      fail("refers to vertex " + std::to_string(vertices[k]) + ", but there are " +
           std::to_string(n_vertices) + " vertices");
    }
    for (int earlier = 0; earlier < k; ++earlier) {
      if (vertices[earlier] == vertices[k]) {
        fail("has vertex " + std::to_string(vertices[k]) + " twice");
      }
    }
  }
  if (cell >= kMaxCells) fail("is one more than this program can handle");
}

}  // namespace

bool TetConnectivity::is_boundary(CellHandle cell) const {
  const auto faces = cf_range(cell);
  return std::any_of(faces.begin(), faces.end(),
                     [&](FaceHandle face) { return is_boundary(face); });
}

TetConnectivity::EdgeHandle TetConnectivity::find_edge(VertexHandle a, VertexHandle b) const {
  for (const EdgeHandle edge : ve_range(a)) {
    const auto ends = ev_range(edge);
    if (a != b && (ends[0] == b || ends[1] == b)) return edge;
  }
  return EdgeHandle();
}

TetConnectivity::FaceHandle TetConnectivity::find_face(VertexHandle a, VertexHandle b,
                                                       VertexHandle c) const {
  const auto wanted = ascending(a.idx(), b.idx(), c.idx());
  for (const CellHandle cell : vc_range(a)) {
    for (const FaceHandle face : cf_range(cell)) {
      const auto v = fv_range(face);
      if (ascending(v[0].idx(), v[1].idx(), v[2].idx()) == wanted) return face;
    }
  }
  return FaceHandle();
}

void TetConnectivity::reserve(std::size_t vertices, std::size_t edges, std::size_t faces,
                              std::size_t cells) {
  last_corner_.reserve(vertices);
  last_end_.reserve(vertices);
  boundary_faces_at_vertex_.reserve(vertices);
  edge_vertices_.reserve(2 * edges);
  next_end_.reserve(2 * edges);
  boundary_faces_at_edge_.reserve(edges);
  face_vertices_.reserve(3 * faces);
  face_cells_.reserve(2 * faces);
  cell_vertices_.reserve(4 * cells);
  cell_faces_.reserve(4 * cells);
  next_corner_.reserve(4 * cells);
  face_of_.reserve(faces);
  edge_of_.reserve(edges);
}

TetConnectivity::VertexHandle TetConnectivity::append_vertex() {
  last_corner_.push_back(-1);
  last_end_.push_back(-1);
  boundary_faces_at_vertex_.push_back(0);
  return VertexHandle(static_cast<int>(n_vertices()) - 1);
}

CellHandle TetConnectivity::append_cell(const std::array<int, 4>& vertices) {
  check_vertices(vertices, n_vertices(), n_cells());
  restore_tables();
  const auto known_faces = existing_faces(vertices);
  const auto edges = append_edges(vertices);
  const int cell = static_cast<int>(n_cells());
  for (int k = 0; k < 4; ++k) {
    const bool is_new = known_faces[k] < 0;
    const int face = is_new ? static_cast<int>(n_faces()) : known_faces[k];
    if (is_new) {
      append_face(vertices, k);
      face_cells_.insert(face_cells_.end(), {cell, -1});
    } else {
      face_cells_[2 * face + 1] = cell;
    }
    count_boundary(k, vertices, edges, is_new ? 1 : -1);
    cell_faces_.push_back(face);
  }
  for (int k = 0; k < 4; ++k) {
    append_to_list(next_corner_, last_corner_[vertices[k]], 4 * cell + k);
  }
  cell_vertices_.insert(cell_vertices_.end(), vertices.begin(), vertices.end());
  return CellHandle(cell);
}

std::array<int, 4> TetConnectivity::existing_faces(const std::array<int, 4>& vertices) const {
  std::array<int, 4> faces;
  for (int k = 0; k < 4; ++k) {
    faces[k] = face_of_.find(face_key(vertices, k));
    if (faces[k] < 0) continue;
    const int* const cells = &face_cells_[std::size_t{2} * faces[k]];
    if (cells[1] < 0) continue;
    const auto key = face_key(vertices, k);
    throw InputError(
        "cells " + std::to_string(cells[0]) + ", " + std::to_string(cells[1]) + " and " + std::to_string(n_cells()) +
        " of the tetrahedral mesh share one face, of vertices " + std::to_string(key[0]) + ", " +
        std::to_string(key[1]) + " and " + std::to_string(key[2]));
  }
  return faces;
}

std::array<int, 6> TetConnectivity::append_edges(const std::array<int, 4>& vertices) {
  std::array<int, 6> edges;
  for (int k = 0; k < 6; ++k) {
    const auto key = ascending(vertices[kEdgeCorners[k][0]], vertices[kEdgeCorners[k][1]]);
    const int next = static_cast<int>(n_edges());
    edges[k] = edge_of_.insert(key, next);
    if (edges[k] != next) continue;
    edge_vertices_.insert(edge_vertices_.end(), key.begin(), key.end());
    boundary_faces_at_edge_.push_back(0);
    for (int side = 0; side < 2; ++side) {
      append_to_list(next_end_, last_end_[key[side]], 2 * next + side);
    }
  }
  return edges;
}

void TetConnectivity::append_face(const std::array<int, 4>& vertices, int opposite) {
  face_of_.insert(face_key(vertices, opposite), static_cast<int>(n_faces()));
  for (const int corner : kFaceCorners[opposite]) face_vertices_.push_back(vertices[corner]);
}

void TetConnectivity::count_boundary(int opposite, const std::array<int, 4>& vertices,
                                     const std::array<int, 6>& edges, int change) {
  for (const int corner : kFaceCorners[opposite]) {
    boundary_faces_at_vertex_[vertices[corner]] += change;
  }
  for (const int edge : kFaceEdges[opposite]) boundary_faces_at_edge_[edges[edge]] += change;
}

void TetConnectivity::forget_tables() {
  face_of_ = {};
  edge_of_ = {};
}

void TetConnectivity::restore_tables() {
  if (face_of_.size() == n_faces() && edge_of_.size() == n_edges()) return;
  forget_tables();
  face_of_.reserve(n_faces());
  for (const FaceHandle face : faces()) {
    const auto v = fv_range(face);
    face_of_.insert(ascending(v[0].idx(), v[1].idx(), v[2].idx()), face.idx());
  }
  edge_of_.reserve(n_edges());
  for (const EdgeHandle edge : edges()) {
    const auto v = ev_range(edge);
    edge_of_.insert({v[0].idx(), v[1].idx()}, edge.idx());
  }
}

}  // namespace flbc::openmesh
