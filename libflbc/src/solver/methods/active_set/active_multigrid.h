// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The linear step of the iteration on the active set.
#pragma once

#include <vector>

#include "base/aligned_array.h"
#include "linear/matrix_arrays.h"
#include "linear/row_matrix.h"
#include "solver/methods/active_set/active_data.h"

namespace flbc::active_set {

//! Colored blocks of unknowns. Blocks of one color are not coupled, so several threads can sweep
//! them with a reproducible result.
struct SweepOrder {
  std::vector<Index> position;       //!< of every unknown
  std::vector<Index> block_starts;   //!< positions, blocks + 1
  std::vector<Index> colour_starts;  //!< blocks, colors + 1
};

//! Consecutive unknowns stay together. \param matrix  symmetric
SweepOrder sweep_order(const RowMatrix& matrix);

//! An approximate minimizer of d^T K d / 2 - b^T d over all changes d of weights that stay within
//! the active set, sum to zero, and reproduce zero at every vertex,
//!
//!     T = { d : d_i(v) = 0 outside the support of v, sum_i d_i(v) = 0, sum_i d_i(v) c_i = 0 }.
//!
//! One symmetric multigrid cycle. The constraints couple the control points, so the smoother
//! includes them. The block of K of a vertex is K_vv times the identity. The exact minimizer over
//! changes of this vertex in T is P_v r / K_vv, where P_v projects the residual r onto those
//! changes. Coarse unknowns are those of smoothed aggregation; a control point is active at one
//! only if it is active at every vertex where its function is nonzero. All corrections are then in
//! T, the cycle B^-1 is a subspace correction with exact local minimizers, and B >= K on T.
template <class Scalar, int Dim>
class ActiveMultigrid {
 public:
  //! \param matrix  K, symmetric positive definite, both triangles, in the order of the unknowns
  //! \param order  of the unknowns in the rows
  //! \param lists  of the rows, possibly more than unknowns; kept by reference
  //! \param basis  of the rows (see row_bases()); kept by reference
  ActiveMultigrid(RowMatrix matrix, const SweepOrder& order, const PackedLists& lists,
                  const AlignedArray<Scalar>& basis, const PointList<Dim>& control_points,
                  const Kernel<Scalar, Dim>& kernel);

  //! One cycle, in place, by all threads; bit-identical for any number of threads.
  void cycle(Scalar* rows);

 private:
  struct LevelData {
    SweepOrder order;
    SweepArrays<Scalar> matrix;
    MatrixArrays<Scalar> prolongation, restriction;
    PackedLists own_lists;  // of coarse levels
    AlignedArray<Scalar> own_basis;
    AlignedArray<Scalar> right_side, solution, rest;

    Index num_rows() const { return static_cast<Index>(matrix.inverse_diagonal.size()); }
  };

  LevelData coarsen(RowMatrix& matrix, const PackedLists& lists, LevelData& level) const;
  PackedLists coarse_lists(const PackedLists& fine, const RowMatrix& restriction) const;
  Level<Scalar> view(std::size_t l, const Scalar* right_side);
  void multiply(const Entries<Scalar>& entries, const Lists& target_lists,
                const Lists& source_lists, Scalar factor, const Scalar* source, bool adds,
                Scalar* target, Index num_rows, Scalar* work) const;
  void descend(std::size_t l, const Scalar* right_side, Scalar* work);
  void ascend(std::size_t l, const Scalar* right_side, Scalar* work);

  const Kernel<Scalar, Dim>& kernel_;
  const ControlPoint n_;
  const std::size_t work_size_;
  const PackedLists& lists_;
  const AlignedArray<Scalar>& basis_;
  std::vector<LevelData> levels_;
};

}  // namespace flbc::active_set
