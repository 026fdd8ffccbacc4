// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Cells that follow each other share one list of control points, so that the inner loops of the
//! compact splitting serve them as they are.
#pragma once

#include <vector>

#include "base/aligned_array.h"
#include "solver/methods/active_set/packed_lists.h"
#include "solver/methods/splitting/compact_data.h"

namespace flbc::active_set {

//! As many cells as share most of their corners and control points.
constexpr Index kPatchCells = 64;

//! Some cells and the rows of their corners. The places are those in the arrays of CellPatches.
struct Patch {
  Index first_cell, end_cell;
  Index first_row, num_interior, num_rows;
  std::size_t first_item, stride;  // of the list, padded
  std::size_t first_number;        // of the radii; of P, times Dim
};

//! All cells with interior corners, in patches.
template <class Scalar, int Dim>
struct CellPatches {
  std::vector<Patch> patches;
  std::vector<compact::Cell<Scalar, Dim>> cells;  // corners by their place among the patch's rows
  std::vector<Index> cell_index;                  // of the mesh
  std::vector<Index> place_of_cell;               // of a mesh's cell in `cells`, -1 for none
  std::vector<Index> rows;                        // of the splitting, interior ones first
  std::vector<ControlPoint> items;                // ascending; n in the padding
  AlignedArray<unsigned char> radius;             // as the loops store numbers
  std::vector<std::size_t> leaves;  // place where a row's part of the divergence is left, as rows
  std::size_t num_left = 0;         // numbers
  std::size_t largest_block = 0;    // numbers of a patch's rows
  VertexItems<std::size_t> left;    // of every interior row, the places of its parts
};

//! \param data  rows and cells \param lists  of all rows \param unit  u
template <class Scalar, int Dim>
CellPatches<Scalar, Dim> make_patches(const LbcProblem<Dim>& problem,
                                      const splitting::Metric& metric, double unit,
                                      compact::CompactData<Scalar, Dim>& data,
                                      const PackedLists& lists,
                                      const compact::Loops<Scalar, Dim>& loops);

//! Places of control points in a patch's list; those that are not there keep what they had.
template <class Patches>
void set_slots(const Patches& patches, const Patch& patch, std::vector<std::uint16_t>& slot_of) {
  for (std::size_t j = 0; j < patch.stride; ++j) {
    slot_of[patches.items[patch.first_item + j]] = static_cast<std::uint16_t>(j);
  }
}

}  // namespace flbc::active_set
