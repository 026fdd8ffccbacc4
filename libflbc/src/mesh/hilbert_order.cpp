// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/hilbert_order.h"

#include <algorithm>
#include <numeric>

#include "base/instantiate.h"
#include "mesh/cell_geometry.h"

namespace flbc {

namespace {

// Arithmetic on the Dim-bit numbers of the 2^Dim subcells of a cell.
template <int Dim>
struct Bits {
  static constexpr unsigned kMask = (1u << Dim) - 1;

  static unsigned rotate_left(unsigned x, int by) {
    return ((x << by) | (x >> (Dim - by))) & kMask;
  }
  static unsigned rotate_right(unsigned x, int by) { return rotate_left(x, (Dim - by) % Dim); }
  static unsigned gray(unsigned rank) { return rank ^ (rank >> 1); }
  static unsigned gray_rank(unsigned code) {
    unsigned rank = code;
    for (int shift = 1; shift < Dim; shift *= 2) rank ^= rank >> shift;
    return rank;
  }
  static int trailing_ones(unsigned x) { return __builtin_ctz(~x); }
};

template <int Dim>
constexpr int kLevels = Dim == 2 ? 31 : 21;  // as many as fit into 63 bits

}  // namespace

// In each level the curve runs through the 2^Dim subcells in the order of a Gray code, reflected by
// `entry` and rotated by `direction` so that its pieces join end to end (Hamilton, "Compact Hilbert
// Indices", 2006).
template <int Dim>
std::uint64_t hilbert_index(const std::uint32_t (&cell)[Dim], int levels) {
  using B = Bits<Dim>;
  std::uint64_t index = 0;
  unsigned entry = 0;
  int direction = 0;
  for (int level = levels - 1; level >= 0; --level) {
    unsigned subcell = 0;
    for (int axis = 0; axis < Dim; ++axis) subcell |= ((cell[axis] >> level) & 1u) << axis;

    const int turn = (direction + 1) % Dim;
    const unsigned rank = B::gray_rank(B::rotate_right(subcell ^ entry, turn));
    index = (index << Dim) | rank;

    const unsigned entry_of_rank = rank == 0 ? 0 : B::gray((rank - 1) & ~1u);
    const int direction_of_rank =
        rank == 0 ? 0 : B::trailing_ones(rank % 2 == 0 ? rank - 1 : rank) % Dim;
    entry ^= B::rotate_left(entry_of_rank, turn);
    direction = (direction + direction_of_rank + 1) % Dim;
  }
  return index;
}

template <int Dim>
std::vector<Index> spatial_order(const PointList<Dim>& points) {
  std::vector<Index> order(static_cast<std::size_t>(points.cols()));
  std::iota(order.begin(), order.end(), 0);
  if (order.empty()) return order;

  const Vector<Dim> low = points.rowwise().minCoeff();
  const double extent = (points.rowwise().maxCoeff() - low).maxCoeff();
  const double last_cell = double((std::uint64_t{1} << kLevels<Dim>)-1);
  const double scale = extent > 0 ? last_cell / extent : 0.0;

  std::vector<std::uint64_t> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    std::uint32_t cell[Dim];
    for (int axis = 0; axis < Dim; ++axis) {
      const double offset = (points(axis, Eigen::Index(i)) - low(axis)) * scale;
      cell[axis] = static_cast<std::uint32_t>(std::min(offset, last_cell));
    }
    place[i] = hilbert_index<Dim>(cell, kLevels<Dim>);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return place[a] < place[b]; });
  return order;
}

template <int Dim>
void reorder_in_space(DomainMesh<Dim>& mesh, Index num_fixed) {
  const Index num_free = mesh.num_vertices() - num_fixed;
  const PointList<Dim> free_points = mesh.points.rightCols(num_free);
  const std::vector<Index> point_order = spatial_order<Dim>(free_points);
  std::vector<Index> new_number(static_cast<std::size_t>(mesh.num_vertices()));
  std::iota(new_number.begin(), new_number.end(), 0);
  for (Index i = 0; i < num_free; ++i) {
    mesh.points.col(num_fixed + i) = free_points.col(point_order[i]);
    new_number[num_fixed + point_order[i]] = num_fixed + i;
  }
  for (Index& vertex : mesh.cells.reshaped()) vertex = new_number[vertex];

  const std::vector<Index> cell_order = spatial_order<Dim>(centroids(mesh.points, mesh.cells));
  const CellList<Dim> cells = mesh.cells;
  for (Index i = 0; i < mesh.num_cells(); ++i) mesh.cells.col(i) = cells.col(cell_order[i]);
}

FLBC_INSTANTIATE_FUNCTION(hilbert_index)
FLBC_INSTANTIATE_FUNCTION(spatial_order)
FLBC_INSTANTIATE_FUNCTION(reorder_in_space)

}  // namespace flbc
