// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/tetgen/cell_complex.h"

#include <algorithm>
#include <iterator>
#include <map>

namespace flbc {

namespace {

bool contains(const CellComplex::Corners& corners, Index vertex) {
  return std::find(corners.begin(), corners.end(), vertex) != corners.end();
}

}  // namespace

CellComplex::CellComplex(const DomainMesh<3>& mesh)
    : cells_at_(static_cast<std::size_t>(mesh.num_vertices())) {
  for (Index v = 0; v < mesh.num_vertices(); ++v) points_.push_back(mesh.points.col(v));
  for (Index c = 0; c < mesh.num_cells(); ++c) {
    add_cell({mesh.cells(0, c), mesh.cells(1, c), mesh.cells(2, c), mesh.cells(3, c)});
  }
}

bool CellComplex::is_used(Index vertex) const {
  const std::vector<Index>& cells = cells_at_[vertex];
  return std::any_of(cells.begin(), cells.end(), [&](Index cell) { return is_alive(cell); });
}

std::array<Vector<3>, 4> CellComplex::corner_points(Index cell) const {
  const Corners& c = cells_[cell];
  return {points_[c[0]], points_[c[1]], points_[c[2]], points_[c[3]]};
}

Index CellComplex::add_vertex(const Vector<3>& point) {
  points_.push_back(point);
  cells_at_.emplace_back();
  return num_vertices() - 1;
}

void CellComplex::split(const Simplex& simplex, Index vertex) {
  const std::vector<Index> candidates = cells_at_[simplex.front()];  // a copy: it grows below
  for (Index cell : candidates) {
    const Corners whole = cells_[cell];
    const bool has_simplex = std::all_of(simplex.begin(), simplex.end(),
                                         [&](Index corner) { return contains(whole, corner); });
    if (!is_alive(cell) || !has_simplex) continue;
    remove_cell(cell);
    for (Index replaced : simplex) {
      Corners part = whole;
      std::replace(part.begin(), part.end(), replaced, vertex);
      add_cell(part);
    }
  }
}

std::vector<CellComplex::Simplex> CellComplex::boundary_faces_at(Index vertex) const {
  std::map<Simplex, int> num_cells_of;
  for (Index cell : cells_at_[vertex]) {
    if (!is_alive(cell)) continue;
    for (Index opposite : cells_[cell]) {
      if (opposite == vertex) continue;
      Simplex face;
      std::copy_if(cells_[cell].begin(), cells_[cell].end(), std::back_inserter(face),
                   [&](Index corner) { return corner != opposite; });
      std::sort(face.begin(), face.end());
      ++num_cells_of[face];
    }
  }
  std::vector<Simplex> boundary;
  for (const auto& [face, count] : num_cells_of) {
    if (count == 1) boundary.push_back(face);
  }
  return boundary;
}

DomainMesh<3> CellComplex::to_mesh() const {
  DomainMesh<3> mesh;
  mesh.points.resize(3, num_vertices());
  for (Index v = 0; v < num_vertices(); ++v) mesh.points.col(v) = points_[v];
  mesh.cells.resize(4, std::count(is_alive_.begin(), is_alive_.end(), true));
  Index count = 0;
  for (Index cell = 0; cell < num_cells(); ++cell) {
    if (!is_alive(cell)) continue;
    for (int k = 0; k < 4; ++k) mesh.cells(k, count) = cells_[cell][k];
    ++count;
  }
  return mesh;
}

void CellComplex::add_cell(const Corners& corners) {
  for (Index vertex : corners) cells_at_[vertex].push_back(num_cells());
  cells_.push_back(corners);
  is_alive_.push_back(true);
}

}  // namespace flbc
