// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The compact splitting with weights that are zero outside an active set.
#pragma once

#include <memory>
#include <vector>

#include "solver/methods/active_set/active_data.h"
#include "solver/methods/active_set/active_multigrid.h"
#include "solver/methods/splitting/splitting.h"

namespace flbc::active_set {

using splitting::Parameters;

//! The iteration of compact_splitting.h for weights that vanish outside the active set: the pairs
//! of vertices and control points whose weights may be positive at the optimum. Nothing else is
//! stored or computed. Its limit is the optimum among such weights, which is the true optimum if
//! the set contains its supports. The set grows where weights reach its border. ActiveMultigrid
//! performs the linear step; the units are those of compact_kernel.h.
template <class Scalar, int Dim>
class ActiveSplitting final : public splitting::Splitting<Scalar, Dim> {
 public:
  //! \param metric  see splitting/metric.h \param active  initial pairs, with feasible weights
  ActiveSplitting(const LbcProblem<Dim>& problem, splitting::Metric metric,
                  const Parameters& parameters, ActiveLists active);

  //! Extends the active set if weights reach its border.
  bool adapt(const Milestone& at) override;

  Weights weights() const override;

  //! Only if all pairs that masks allow are active: duals of others are not known.
  bool can_certify() const override { return complete_; }
  Certificate certify(const WeightMatrix& weights, Proof* proof) const override;

  void describe(SolveReport& report) const override;

 private:
  using Base = splitting::Splitting<Scalar, Dim>;
  using Base::data_, Base::kernel_, Base::metric_, Base::n_, Base::P_, Base::parameters_,
      Base::problem_, Base::rows_, Base::sigma, Base::unit_;
  using typename Base::Row, typename Base::RowLoop, typename Base::SliceLoop, typename Base::State;

  State patch_state(const Patch& patch);
  template <class Body>
  void for_patches(const Body& body);
  void gather(const Patch& patch, const std::vector<std::uint16_t>& slot_of,
              const AlignedArray<Scalar>& numbers, Index count, AlignedArray<Scalar>& block) const;
  State row_state(Index row);
  void solve(SliceLoop loop, double relaxation) override;
  double pass_rows(RowLoop loop) override;
  Row row(Index index) const override {
    const std::size_t start = lists_->starts[index];
    return {start, lists_->counts[index], lists_->items.data() + start};
  }
  Vectors<Dim> cell_dual(Index cell) const override;
  void set_cell_dual(const VectorsAt<Dim>& flux_density) override;
  void set_weights(const VectorsAt<1>& weights) override;
  ActiveLists larger_set(const Milestone& at) const;

  const Kernel<Scalar, Dim>& list_kernel_;
  ActiveLists active_;
  // of the rows: interior ones in the order of the sweeps, then the boundary
  std::unique_ptr<PackedLists> lists_;
  std::vector<Scalar> targets_;
  std::unique_ptr<AlignedArray<Scalar>> bases_;
  CellPatches<Scalar, Dim> patches_;
  std::unique_ptr<ActiveMultigrid<Scalar, Dim>> multigrid_;
  AlignedArray<Scalar> left_;
  int growths_ = 0;
  bool complete_ = false;
};

}  // namespace flbc::active_set
