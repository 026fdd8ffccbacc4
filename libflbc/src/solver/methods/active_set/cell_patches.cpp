// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/active_set/cell_patches.h"

#include <algorithm>
#include <cmath>

#include "base/padded_rows.h"
#include "mesh/cell_geometry.h"

namespace flbc::active_set {
namespace {

// Rows of a patch's corners, interior ones first, and cells in terms of these.
template <class Scalar, int Dim>
void add_rows(Index num_interior, CellPatches<Scalar, Dim>& result, Patch& patch) {
  std::vector<Index> rows;
  for (Index s = patch.first_cell; s < patch.end_cell; ++s) {
    rows.insert(rows.end(), result.cells[s].rows, result.cells[s].rows + Dim + 1);
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  const auto place_of = [&](Index row) {
    return static_cast<Index>(std::lower_bound(rows.begin(), rows.end(), row) - rows.begin());
  };
  for (Index s = patch.first_cell; s < patch.end_cell; ++s) {
    for (auto& row : result.cells[s].rows) row = place_of(row);
  }
  patch.first_row = static_cast<Index>(result.rows.size());
  patch.num_rows = static_cast<Index>(rows.size());
  patch.num_interior = place_of(num_interior);
  result.rows.insert(result.rows.end(), rows.begin(), rows.end());
}

// The union of its rows' lists.
template <class Scalar, int Dim>
void add_list(const PackedLists& lists, ControlPoint n, CellPatches<Scalar, Dim>& result,
              Patch& patch) {
  std::vector<ControlPoint> items;
  for (Index k = 0; k < patch.num_rows; ++k) {
    const Index row = result.rows[patch.first_row + k];
    const ControlPoint* first = lists.items.data() + lists.starts[row];
    items.insert(items.end(), first, first + lists.counts[row]);
  }
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
  items.resize(padded(items.size()), n);
  patch.first_item = result.items.size();
  patch.stride = items.size();
  result.items.insert(result.items.end(), items.begin(), items.end());
}

// Where each interior row of a patch leaves its part of the divergence.
template <class Scalar, int Dim>
void add_leaves(const PackedLists& lists, CellPatches<Scalar, Dim>& result, const Patch& patch) {
  for (Index k = 0; k < patch.num_rows; ++k) {
    const Index row = result.rows[patch.first_row + k];
    result.leaves.push_back(result.num_left);
    if (k < patch.num_interior) result.num_left += lists.starts[row + 1] - lists.starts[row];
  }
}

template <class Scalar, int Dim>
void set_up_radii(const LbcProblem<Dim>& problem, const splitting::Metric& metric, double unit,
                  const compact::Loops<Scalar, Dim>& loops, CellPatches<Scalar, Dim>& result) {
  const Patch& last = result.patches.back();
  result.radius = AlignedArray<unsigned char>(
      loops.bytes * (last.first_number + (last.end_cell - last.first_cell) * last.stride));
#pragma omp parallel
  {
    AlignedArray<Scalar> radii(padded(static_cast<std::size_t>(problem.num_control_points()) + 1));
#pragma omp for schedule(static)
    for (std::size_t p = 0; p < result.patches.size(); ++p) {
      const Patch& patch = result.patches[p];
      for (Index k = patch.first_cell; k < patch.end_cell; ++k) {
        const Index s = result.cell_index[k];
        const double scale = compact::dual_scale(problem, metric, unit, s);
        for (std::size_t j = 0; j < patch.stride; ++j) {
          const Index i = result.items[patch.first_item + j];
          const bool pads = i >= problem.num_control_points();
          radii[j] =
              pads
                  ? Scalar(0)
                  : static_cast<Scalar>(scale * std::max(problem.phi(i, s), compact::kSmallestPhi));
        }
        loops.encode(radii.data(), result.radius.data(),
                     patch.first_number + (k - patch.first_cell) * patch.stride, patch.stride);
      }
    }
  }
}

}  // namespace

template <class Scalar, int Dim>
CellPatches<Scalar, Dim> make_patches(const LbcProblem<Dim>& problem,
                                      const splitting::Metric& metric, double unit,
                                      compact::CompactData<Scalar, Dim>& data,
                                      const PackedLists& lists,
                                      const compact::Loops<Scalar, Dim>& loops) {
  CellPatches<Scalar, Dim> result;
  const auto num_interior = static_cast<Index>(data.vertices.size());
  const auto n = static_cast<ControlPoint>(problem.num_control_points());
  result.cells = std::move(data.cells);
  result.cell_index = std::move(data.cell_index);
  const auto num_cells = static_cast<Index>(result.cells.size());
  result.place_of_cell.assign(problem.mesh.num_cells(), -1);
  for (Index k = 0; k < num_cells; ++k) result.place_of_cell[result.cell_index[k]] = k;
  std::size_t next_number = 0;
  for (Index first = 0; first < num_cells; first += kPatchCells) {
    Patch patch{};
    patch.first_cell = first;
    patch.end_cell = std::min(num_cells, first + kPatchCells);
    add_rows(num_interior, result, patch);
    add_list(lists, n, result, patch);
    add_leaves(lists, result, patch);
    patch.first_number = next_number;
    next_number += (patch.end_cell - patch.first_cell) * patch.stride;
    result.largest_block = std::max(result.largest_block, patch.num_rows * patch.stride);
    result.patches.push_back(patch);
  }
  if (!result.patches.empty()) set_up_radii(problem, metric, unit, loops, result);
  result.left = items_by_vertex<std::size_t>(num_interior, [&](const auto& visit) {
    for (const Patch& patch : result.patches) {
      for (Index k = 0; k < patch.num_interior; ++k) {
        visit(result.rows[patch.first_row + k], result.leaves[patch.first_row + k]);
      }
    }
  });
  return result;
}

#define FLBC_INSTANTIATE(Scalar, Dim)                           \
  template CellPatches<Scalar, Dim> make_patches(               \
      const LbcProblem<Dim>&, const splitting::Metric&, double, \
      compact::CompactData<Scalar, Dim>&, const PackedLists&, const compact::Loops<Scalar, Dim>&);
FLBC_INSTANTIATE(float, 2)
FLBC_INSTANTIATE(float, 3)
FLBC_INSTANTIATE(double, 2)
FLBC_INSTANTIATE(double, 3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::active_set
