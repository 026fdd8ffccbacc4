// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Constants of the iteration on the active set: rows of different lengths in one array, and their
//! constraints. Consecutive cells share one list of control points, so the inner loops of the
//! compact splitting apply unchanged.
#pragma once

#include <vector>

#include "base/aligned_array.h"
#include "base/padded_rows.h"
#include "base/parallel.h"
#include "solver/methods/active_set/active_kernel.h"
#include "solver/methods/active_set/active_lists.h"
#include "solver/methods/splitting/compact_data.h"

namespace flbc::active_set {

//! The arrays referenced by Lists.
struct PackedLists {
  std::vector<std::size_t> starts{0};
  std::vector<std::int32_t> counts;
  std::vector<ControlPoint> items;

  Lists view() const { return {starts.data(), counts.data(), items.data()}; }
  Index num_rows() const { return static_cast<Index>(counts.size()); }
  //! Number of values of all rows, including padding.
  std::size_t size() const { return starts.back(); }

  //! Adds a row. \param n  value of the padding
  void append(const ActiveLists::Range& list, ControlPoint n);
};

//! Orthonormal bases of [1; c] on the control points of every row: Dim + 1 rows of its length each.
//! Some are zero if the control points are coplanar or too few.
//! \param points  Dim x rows, or without columns \param targets  Q^T w of all w on the list that
//! sum to one and reproduce the point of the row, Dim + 1 values per row; null without points
template <class Scalar, int Dim>
AlignedArray<Scalar> row_bases(const PackedLists& lists, const PointList<Dim>& control_points,
                               const PointList<Dim>& points, std::vector<Scalar>* targets);

//! Number of cells per patch, such that cells share most of their corners and control points.
constexpr Index kPatchCells = 64;

//! A few cells and the rows of their corners, as ranges in the arrays of CellPatches.
struct Patch {
  Index first_cell, end_cell;
  Index first_row, num_interior, num_rows;
  std::size_t first_item, stride;  // of the list, padded
  std::size_t first_number;        // of the radii; of P, times Dim

  //! The first value of a cell.
  std::size_t number_of(Index cell) const { return first_number + (cell - first_cell) * stride; }
};

//! All cells with interior corners, in patches.
template <class Scalar, int Dim>
struct CellPatches {
  std::vector<Patch> patches;
  std::vector<compact::Cell<Scalar, Dim>> cells;  // corners by their position among the rows of the
                                                  // patch
  std::vector<Index> cell_index;                  // of the mesh
  std::vector<Index> place_of_cell;               // per mesh cell: position in `cells`; -1: none
  std::vector<Index> rows;                        // of the splitting, interior ones first
  std::vector<ControlPoint> items;                // ascending; n in the padding
  AlignedArray<Scalar> radius;
  std::size_t num_numbers = 0;      // of all cells, per component
  std::vector<std::size_t> leaves;  // location of the divergence contribution of a row, ordered as
                                    // rows
  std::size_t num_left = 0;         // numbers
  std::size_t largest_block = 0;    // number of values of the rows of a patch
  VertexItems<std::size_t> left;    // per interior row, the locations of its contributions
};

//! \param data  rows and cells \param lists  of all rows \param unit  u
template <class Scalar, int Dim>
CellPatches<Scalar, Dim> make_patches(const LbcProblem<Dim>& problem,
                                      const splitting::Metric& metric, double unit,
                                      compact::CompactData<Scalar, Dim>& data,
                                      const PackedLists& lists);

//! Stores values of all cells, `Rows` per control point; zero in the padding.
//! \param of_cell  number(control point, row) of a cell of the mesh
template <int Rows, class Scalar, int Dim, class OfCell>
void store_in_cells(const CellPatches<Scalar, Dim>& patches, Index n, AlignedArray<Scalar>& stored,
                    const OfCell& of_cell) {
  parallel_for(
      patches.patches.size(),
      [&](std::size_t p) {
        const Patch& patch = patches.patches[p];
        for (Index k = patch.first_cell; k < patch.end_cell; ++k) {
          const auto number_at = of_cell(patches.cell_index[k]);
          Scalar* rows = stored.data() + Rows * patch.number_of(k);
          for (std::size_t j = 0; j < patch.stride; ++j) {
            const Index i = patches.items[patch.first_item + j];
            for (int r = 0; r < Rows; ++r) {
              rows[r * patch.stride + j] = i < n ? static_cast<Scalar>(number_at(i, r)) : Scalar(0);
            }
          }
        }
      },
      2);
}

}  // namespace flbc::active_set
