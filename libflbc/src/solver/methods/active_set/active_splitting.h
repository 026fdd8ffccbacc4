// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The compact splitting with weights that are zero outside an active set.
#pragma once

#include <vector>

#include "base/aligned_array.h"
#include "flbc/lbc_problem.h"
#include "flbc/sparse_weights.h"
#include "solver/methods/active_set/active_data.h"
#include "solver/methods/active_set/active_multigrid.h"
#include "solver/methods/splitting/compact_data.h"
#include "solver/methods/splitting/penalty_rule.h"
#include "solver/methods/splitting/row_state.h"
#include "solver/run/iteration.h"

namespace flbc::active_set {

//! The iteration of compact_splitting.h for weights that vanish outside the active set, where
//! nothing is stored or computed. Its limit is the optimum among such weights. This is the true
//! optimum if the set contains its supports. ActiveMultigrid performs the linear step; the units
//! are those of compact_kernel.h. The set is fixed.
template <class Scalar, int Dim>
class ActiveSplitting {
 public:
  //! \param metric  see splitting_data.h
  //! \param penalty  rho > 0
  //! \param relaxation  alpha in (0, 2)
  //! \param half  whether P and the radii are stored in half precision
  //! \param active  with weights for every vertex
  //! \param system  of problem and metric, see splitting::system_matrix()
  ActiveSplitting(const LbcProblem<Dim>& problem, splitting::Metric metric, double penalty,
                  double relaxation, bool half, ActiveLists active, const RowMatrix& system);

  //! Starts from given weights and duals. \param balances  whether the penalty will be balanced
  void start(const Start<Dim>& start, bool balances = false);

  //! See CompactSplitting.
  Step iterate(bool measure, splitting::Due due = splitting::Due::kNothing);

  //! Changes rho, keeping weights and duals, and performs the w_step that waited for it.
  void set_penalty(double penalty);

  void store_in_single();

  //! See PenaltyRule.
  splitting::BalanceLengths lengths_since_start();

  double penalty() const { return penalty_; }
  bool stores_half() const { return loops_->bytes < sizeof(Scalar); }
  const ActiveLists& active() const { return active_; }

  //! w of an interior vertex, n values, zero for inactive pairs.
  void read_weights(Index vertex, double* weights) const;

  //! w at one entry in the list of an interior vertex.
  double weight(Index vertex, Index place) const {
    return weight_at(lists_.starts[data_.row_of[vertex]] + place);
  }

  //! w of all V vertices.
  SparseWeights sparse_weights() const;

  //! A start for other iterations: views of this one. Flux densities are zero for inactive pairs.
  Start<Dim> state() const { return splitting::start_of<Dim>(*this, n_); }

  bool has_vertex_dual() const { return rows_.S.size() > 0; }
  //! See CompactSplitting.
  Eigen::VectorXd vertex_dual_at(Index vertex) const;
  Vectors<Dim> flux_density(Index cell) const;

  //! Size of the state per cell and control point, in Scalars.
  double state_scalars_per_cell() const;

 private:
  using State = compact::Arrays<Scalar, Dim>;
  using RowLoop = typename compact::Loops<Scalar, Dim>::RowLoop;

  double sigma() const { return penalty_ * unit_; }
  Scalar weight_at(std::size_t place) const;
  State patch_state(const Patch& patch);
  template <class Body>
  void for_patches(bool measures, const Body& body);
  void gather(const Patch& patch, const std::vector<std::uint16_t>& slot_of,
              const AlignedArray<Scalar>& numbers, Index count, AlignedArray<Scalar>& block) const;
  State row_state(Index row);
  double pass_cells(bool measures, double relaxation);
  void collect_divergence();
  compact::RowSums pass_rows(RowLoop loop);
  template <class NumberAt>
  void spread(Index vertex, const NumberAt& number_at, double* numbers) const;
  void set_weights(const VectorsAt<1>& weights);
  void set_cell_dual(const VectorsAt<Dim>& flux_density);
  void set_vertex_dual(const VectorsAt<1>& vertex_dual);

  const LbcProblem<Dim>& problem_;
  const compact::Loops<Scalar, Dim>* loops_;
  const Kernel<Scalar, Dim>& list_kernel_;
  const Index n_;
  const splitting::Metric metric_;
  const double unit_;  // u
  double penalty_;
  const double relaxation_;
  const ActiveLists active_;
  // of the rows: interior ones in the order of the sweeps, then the boundary
  SweepOrder order_;
  compact::CompactData<Scalar, Dim> data_;
  PackedLists lists_;
  std::vector<Scalar> targets_;
  AlignedArray<Scalar> bases_;
  CellPatches<Scalar, Dim> patches_;
  ActiveMultigrid<Scalar, Dim> multigrid_;
  // state, by row and list
  splitting::RowState<Scalar> rows_;
  AlignedArray<Scalar> left_;
  AlignedArray<unsigned char> P_;  // in the storage format of the loops
};

}  // namespace flbc::active_set
