// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The splitting in half precision, and in single precision where half is not enough.
#pragma once

#include <memory>

#include "solver/splitting/compact_splitting.h"

namespace flbc::compact {

//! A CompactSplitting whose P and radii are stored in half precision for the first iterations. Most
//! runs have ended by then; what is left to gain in the others, and the certified gap above all, is
//! lost in the rounding of the duals, so that they go on in single precision from where they are.
template <int Dim>
class HalfThenSingle {
 public:
  static constexpr int kIterationsInHalf = 500;

  //! See CompactSplitting. The storage holds the state in half precision in the end.
  HalfThenSingle(const LbcProblem<Dim>& problem, splitting::Metric metric, double penalty,
                 double relaxation, LinearSolver linear_solver, StateStorage* storage)
      : problem_(problem),
        metric_(metric),
        relaxation_(relaxation),
        linear_solver_(linear_solver),
        half_(problem, std::move(metric), penalty, relaxation, linear_solver, storage) {}

  void resume() { half_.resume(); }
  void start_from_harmonic(int steps) { half_.start_from_harmonic(steps); }
  void start_from_duals(const WeightMatrix& weights, const VectorsAt<Dim>& flux_density,
                        const WeightMatrix& vertex_dual) {
    half_.start_from_duals(weights, flux_density, vertex_dual);
  }

  Step iterate() {
    count();
    return in_use([](auto& splitting) { return splitting.iterate(); });
  }
  Step iterate_measured() {
    count();
    return in_use([](auto& splitting) { return splitting.iterate_measured(); });
  }
  //! Among the first iterations only.
  Step iterate_and_adapt(double ratio, double largest) {
    count();
    return half_.iterate_and_adapt(ratio, largest);
  }

  double penalty() const { return half_.penalty(); }
  splitting::WeightHistory<float> history() const { return half_.history(); }
  void read_row(Index row, float* weights) const {
    in_use([&](const auto& splitting) { splitting.read_row(row, weights); });
  }
  WeightMatrix vertex_dual() const {
    return in_use([](const auto& splitting) { return splitting.vertex_dual(); });
  }
  WeightMatrix weights() const {
    return in_use([](const auto& splitting) { return splitting.weights(); });
  }
  CellFieldView<float, Dim> flux() {
    return in_use([](auto& splitting) { return splitting.flux(); });
  }
  void finish() {
    if (single_) half_.go_on_from(*single_);
    half_.finish();
  }
  double state_scalars_per_cell() const {
    return in_use([](const auto& splitting) { return splitting.state_scalars_per_cell(); });
  }

 private:
  template <class Use>
  auto in_use(const Use& use) {
    return single_ ? use(*single_) : use(half_);
  }
  template <class Use>
  auto in_use(const Use& use) const {
    return single_ ? use(static_cast<const CompactSplitting<float, float, Dim>&>(*single_))
                   : use(half_);
  }

  void count() {
    if (++iteration_ != kIterationsInHalf + 1) return;
    single_ = std::make_unique<CompactSplitting<float, float, Dim>>(
        problem_, metric_, half_.penalty(), relaxation_, linear_solver_);
    single_->go_on_from(half_);
  }

  const LbcProblem<Dim>& problem_;
  const splitting::Metric metric_;
  const double relaxation_;
  const LinearSolver linear_solver_;
  int iteration_ = 0;
  CompactSplitting<float, Half, Dim> half_;
  std::unique_ptr<CompactSplitting<float, float, Dim>> single_;  // once it is needed
};

}  // namespace flbc::compact
