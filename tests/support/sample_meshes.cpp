// SPDX-License-Identifier: BSD-3-Clause
#include "support/sample_meshes.h"

#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "support/simplex.h"

namespace flbc::testing {
namespace {

template <int Dim>
using Coordinates = std::array<Index, Dim + 1>;  // barycentric, in units of 1 / subdivisions

template <int Dim>
double cell_measure(const DomainMesh<Dim>& mesh, Index cell) {
  return signed_simplex_measure<Dim>(corners_of<Dim>(mesh.points, mesh.cells.col(cell)));
}

template <int Dim>
void orient(DomainMesh<Dim>& mesh) {
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    if (cell_measure(mesh, s) < 0) std::swap(mesh.cells(0, s), mesh.cells(1, s));
  }
}

// The cells of a regularly subdivided simplex in barycentric lattice coordinates. The simplex
// k >= x_1 >= .. >= x_Dim >= 0 is a union of lattice cubes' Kuhn cells: monotone paths from p to
// p + (1, .., 1), a step along each axis in any order.
template <int Dim>
std::vector<std::array<Coordinates<Dim>, Dim + 1>> subdivided_simplex(Index k) {
  std::vector<std::array<Coordinates<Dim>, Dim + 1>> cells;
  Index num_cubes = 1;
  for (int axis = 0; axis < Dim; ++axis) num_cubes *= k;
  for (Index cube = 0; cube < num_cubes; ++cube) {
    std::array<int, Dim> order{};
    std::iota(order.begin(), order.end(), 0);
    do {
      std::array<Index, Dim> x{};
      for (Index axis = 0, rest = cube; axis < Dim; ++axis, rest /= k) x[axis] = rest % k;
      std::array<Coordinates<Dim>, Dim + 1> cell{};
      bool inside = true;
      for (int step = 0; step <= Dim; ++step) {
        if (step > 0) ++x[order[step - 1]];
        for (int row = 0; row <= Dim; ++row) {
          cell[step][row] = (row == 0 ? k : x[row - 1]) - (row == Dim ? 0 : x[row]);
          inside = inside && cell[step][row] >= 0;
        }
      }
      if (inside) cells.push_back(cell);
    } while (std::next_permutation(order.begin(), order.end()));
  }
  return cells;
}

// Facets are subdivided alike from both sides, since the pattern cuts edges and triangles in the
// one regular way. Inside a tetrahedron it depends on the order of the corners; ascending numbers
// make finer Kuhn tetrahedra of Kuhn tetrahedra.
template <int Dim>
DomainMesh<Dim> subdivide(const DomainMesh<Dim>& coarse, Index subdivisions) {
  const auto pattern = subdivided_simplex<Dim>(subdivisions);
  std::map<std::map<Index, Index>, Index> numbers;  // {coarse vertex: coordinate > 0} -> vertex
  std::vector<Vector<Dim>> points;
  DomainMesh<Dim> mesh;
  mesh.cells.resize(Dim + 1, coarse.num_cells() * static_cast<Eigen::Index>(pattern.size()));
  Eigen::Index next_cell = 0;
  for (Index s = 0; s < coarse.num_cells(); ++s) {
    auto corners = coarse.cells.col(s).eval();
    std::sort(corners.data(), corners.data() + Dim + 1);
    for (const auto& cell : pattern) {
      for (int k = 0; k <= Dim; ++k) {
        std::map<Index, Index> key;
        Vector<Dim> point = Vector<Dim>::Zero();
        for (int row = 0; row <= Dim; ++row) {
          if (cell[k][row] == 0) continue;
          key[corners[row]] = cell[k][row];
          point += cell[k][row] * coarse.points.col(corners[row]);
        }
        const auto [place, is_new] = numbers.emplace(key, static_cast<Index>(points.size()));
        if (is_new) points.push_back(point / subdivisions);
        mesh.cells(k, next_cell) = place->second;
      }
      ++next_cell;
    }
  }
  mesh.points.resize(Dim, static_cast<Eigen::Index>(points.size()));
  for (std::size_t v = 0; v < points.size(); ++v) mesh.points.col(v) = points[v];
  orient(mesh);
  return mesh;
}

// Uniform in [-1, 1]. The standard library's distributions differ between implementations.
double next_random(std::uint64_t& state) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return static_cast<double>(state >> 32) / 2147483647.5 - 1;
}

template <int Dim>
std::vector<double> least_heights(const DomainMesh<Dim>& mesh) {
  std::vector<double> heights(mesh.num_vertices(), std::numeric_limits<double>::infinity());
  for (const auto& [facet, cells] : cells_by_facet(mesh)) {
    const double base = simplex_measure<Dim>(corners_of<Dim>(mesh.points, facet));
    for (const Index s : cells) {
      const double height = Dim * cell_measure(mesh, s) / base;
      for (const Index v : mesh.cells.col(s)) heights[v] = std::min(heights[v], height);
    }
  }
  return heights;
}

template <int Dim>
void move_interior_vertices(DomainMesh<Dim>& mesh, double jitter) {
  const auto interior = interior_vertices(mesh);
  const auto heights = least_heights(mesh);
  std::uint64_t state = 1;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    if (!interior[v]) continue;
    Vector<Dim> offset;
    for (int k = 0; k < Dim; ++k) offset[k] = next_random(state);
    mesh.points.col(v) += jitter * heights[v] / std::sqrt(double(Dim)) * offset;
  }
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    if (!(cell_measure(mesh, s) > 0)) {
      throw std::invalid_argument("sample mesh: the jitter turns cell " + std::to_string(s) +
                                  " round");
    }
  }
}

}  // namespace

template <int Dim>
Cage<Dim> boundary_of(const DomainMesh<Dim>& mesh) {
  const auto all_facets = cells_by_facet(mesh);
  const auto interior = interior_vertices(mesh);
  std::vector<Index> number(mesh.num_vertices(), -1);
  Cage<Dim> cage;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    if (interior[v]) continue;
    number[v] = cage.size();
    cage.points.conservativeResize(Dim, number[v] + 1);
    cage.points.col(number[v]) = mesh.points.col(v);
  }
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    for (int opposite = 0; opposite <= Dim; ++opposite) {
      std::array<Index, Dim> facet{};
      for (int k = 0, slot = 0; k <= Dim; ++k) {
        if (k != opposite) facet[slot++] = mesh.cells(k, s);
      }
      FacetKey<Dim> key = facet;
      std::sort(key.begin(), key.end());
      if (all_facets.at(key).size() > 1) continue;
      if (opposite % 2 == 1) std::swap(facet[0], facet[1]);
      cage.facets.conservativeResize(Dim, cage.facets.cols() + 1);
      for (int k = 0; k < Dim; ++k) cage.facets(k, cage.facets.cols() - 1) = number[facet[k]];
    }
  }
  return cage;
}

template <int Dim>
Sample<Dim> make_sample(Shape shape, Index subdivisions, double jitter) {
  if (subdivisions < 1) throw std::invalid_argument("sample mesh: subdivisions below 1");
  auto coarse = coarse_mesh<Dim>(shape);
  orient(coarse);
  Sample<Dim> sample;
  sample.cage = boundary_of(coarse);
  sample.mesh = subdivide(coarse, subdivisions);
  sample.name = shape_name(shape) + std::to_string(Dim) + "d_" + std::to_string(subdivisions);
  if (jitter > 0) {
    move_interior_vertices(sample.mesh, jitter);
    sample.name += "_jittered";
  }
  return sample;
}

Cage<3> round_cage(Index k) {
  auto cage = boundary_of(make_sample<3>(Shape::kBox, k).mesh);
  cage.points = (cage.points.array() - 0.5).matrix().colwise().normalized();
  return cage;
}

template <int Dim>
std::vector<Sample<Dim>> samples() {
  const bool flat = Dim == 2;
  return {make_sample<Dim>(Shape::kSimplex, flat ? 10 : 6, 0.25),
          make_sample<Dim>(Shape::kBox, flat ? 8 : 4),
          make_sample<Dim>(Shape::kBox, flat ? 7 : 4, 0.25),
          make_sample<Dim>(Shape::kCorner, flat ? 5 : 4, 0.25),
          make_sample<Dim>(Shape::kRing, flat ? 4 : 3),
          make_sample<Dim>(Shape::kStar, flat ? 6 : 4, 0.25)};
}

#define FLBC_INSTANTIATE(Dim)                                  \
  template Cage<Dim> boundary_of(const DomainMesh<Dim>&);      \
  template Sample<Dim> make_sample<Dim>(Shape, Index, double); \
  template std::vector<Sample<Dim>> samples<Dim>();
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::testing
