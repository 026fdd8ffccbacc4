// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The compact splitting where weights are zero outside of given supports.
#pragma once

#include <functional>
#include <vector>

#include "base/aligned_array.h"
#include "flbc/lbc_problem.h"
#include "flbc/sparse_weights.h"
#include "solver/splitting/compact_splitting.h"
#include "solver/supports/cell_patches.h"
#include "solver/supports/support_multigrid.h"

namespace flbc::supports {

//! The iteration of compact_splitting.h for weights that vanish outside of supports, where nothing
//! is stored or computed. Its limit is the optimum among these, which is the optimum if the
//! supports contain those of the optimum. The linear step is SupportMultigrid's; the units are
//! those of compact_kernel.h.
template <class Scalar, class Stored, int Dim>
class SupportSplitting {
 public:
  static constexpr bool kStoresHalf = std::is_same_v<Stored, compact::Half>;
  static constexpr bool kAdapts = false;
  static constexpr bool kOnSupports = true;

  //! \param metric  see splitting_data.h
  //! \param penalty  rho > 0
  //! \param relaxation  alpha in (0, 2)
  //! \param supports  with weights for every vertex
  SupportSplitting(const LbcProblem<Dim>& problem, splitting::Metric metric, double penalty,
                   double relaxation, SupportLists supports);

  //! Starts from weights and duals that were found elsewhere. Parameters as for CompactSplitting.
  void start_from_duals(const VectorsAt<1>& weights, const VectorsAt<Dim>& flux_density,
                        const VectorsAt<1>& vertex_dual);

  compact::Step iterate() { return step(false); }

  //! The same, and what the constraints lacked, see CompactSplitting.
  compact::Step iterate_measured() { return step(true); }

  double penalty() const { return penalty_; }
  const SupportLists& supports() const { return supports_; }

  //! w of an interior vertex, padded, zero outside its support.
  void read_vertex(Index vertex, Scalar* weights) const;

  //! w at one place of an interior vertex's list of control points.
  double weight(Index vertex, Index place) const {
    return weight_at(lists_.starts[data_.row_of[vertex]] + place);
  }

  //! w of all V vertices.
  SparseWeights sparse_weights() const;

  //! n x V.
  WeightMatrix weights() const { return sparse_weights().dense(); }

  //! w of an interior vertex, n numbers.
  Eigen::VectorXd weights_at(Index vertex) const;

  //! p / A of a cell, n x Dim, zero outside the supports.
  Eigen::Matrix<double, Eigen::Dynamic, Dim> flux_density(Index cell) const;

  bool has_vertex_dual() const { return vertex_dual_.size() > 0; }

  //! q - w of an interior vertex, n numbers.
  Eigen::VectorXd vertex_dual_at(Index vertex) const;

  //! Writes or reads the state, of the same supports and penalty.
  template <class Archive>
  void visit(Archive& archive) {
    archive(extrapolated_, relaxed_, vertex_dual_, residual_, cell_dual_);
  }

  //! Numbers of state held per cell and control point, in units of the Scalar.
  double state_scalars_per_cell() const;

 private:
  SupportSplitting(const LbcProblem<Dim>& problem, splitting::Metric metric, double penalty,
                   double relaxation, SupportLists supports, const RowMatrix& system);

  using State = compact::Arrays<Scalar, Stored, Dim>;
  using RowLoop = typename compact::Kernel<Scalar, Stored, Dim>::RowLoop;

  double sigma() const { return penalty_ * unit_; }
  std::size_t num_interior_numbers() const { return lists_.starts[data_.vertices.size()]; }
  Scalar weight_at(std::size_t place) const;
  PackedLists lists_of_rows() const;
  PointList<Dim> points_of_rows() const;
  State patch_state(const Patch& patch);
  State row_state(Index row);
  double pass_cells(bool measures, double relaxation);
  void collect_divergence();
  compact::RowSums pass_rows(RowLoop loop);
  compact::Step step(bool measures);
  template <class NumberAt>
  Eigen::VectorXd spread(Index vertex, const NumberAt& number_at) const;
  void set_weights(const VectorsAt<1>& weights);
  void set_cell_dual(const VectorsAt<Dim>& flux_density);
  void set_vertex_dual(const VectorsAt<1>& vertex_dual);

  const LbcProblem<Dim>& problem_;
  const compact::Kernel<Scalar, Stored, Dim>& kernel_;
  const Kernel<Scalar, Dim>& list_kernel_;
  const Index n_;
  const splitting::Metric metric_;
  const double unit_;  // u
  const double penalty_;
  const double relaxation_;
  const SupportLists supports_;
  // of the rows: interior ones in the order of the sweeps, then the boundary
  SweepOrder order_;
  compact::CompactData<Scalar, Stored, Dim> data_;
  PackedLists lists_;
  std::vector<Scalar> targets_;
  AlignedArray<Scalar> bases_;
  CellPatches<Scalar, Stored, Dim> patches_;
  SupportMultigrid<Scalar, Dim> multigrid_;
  // state, by row and list; interior rows alone but for a
  AlignedArray<Scalar> extrapolated_;
  AlignedArray<Scalar> relaxed_;
  AlignedArray<Scalar> vertex_dual_;
  AlignedArray<Scalar> residual_;
  AlignedArray<Scalar> difference_;
  AlignedArray<Scalar> left_;
  AlignedArray<Stored> cell_dual_;
};

}  // namespace flbc::supports
