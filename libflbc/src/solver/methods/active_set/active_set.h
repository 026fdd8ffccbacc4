// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Method::kValue on the active set.
#pragma once

#include <memory>

#include "solver/methods/active_set/active_splitting.h"
#include "solver/run/iteration.h"

namespace flbc::active_set {

//! Parameters of an iteration on the active set.
struct Parameters {
  double penalty = 1;     //!< of all pairs
  double part = 1;        //!< factor of the penalty for an active set, where fewer weights move
  double relaxation = 1;  //!< alpha in (0, 2)
  bool half = false;      //!< starts with duals and radii in half precision
  bool balances = false;  //!< adapts the penalty early (splitting/penalty_rule.h)
};

//! The splitting on the active set: the pairs of vertices and control points whose weights may be
//! positive at the optimum. It extends the set where weights reach its border.
template <class Scalar, int Dim>
class ActiveSet final : public Iteration<Dim> {
 public:
  //! \param metric  see splitting/metric.h \param active  initial pairs, with feasible weights
  ActiveSet(const LbcProblem<Dim>& problem, splitting::Metric metric, const Parameters& parameters,
            ActiveLists active);

  //! \param start  not cold
  void start(const Start<Dim>& start) override;
  Step iterate(int made, int count, bool measure) override;
  Weights weights() const override { return {{}, splitting_->sparse_weights()}; }
  void read_weights(Index vertex, double* weights) const override {
    splitting_->read_weights(vertex, weights);
  }
  //! The penalty refers to all pairs.
  Start<Dim> state() const override;

  //! None, because duals are known only for active pairs.
  Certificate certify(const WeightMatrix&) const override { return {}; }

  //! Balances the penalty, extends the set, and switches to single precision. A larger set makes a
  //! new splitting that starts from the current one.
  int adapt(const Milestone& at) override;

  void describe(SolveReport& report) const override;

 private:
  std::unique_ptr<ActiveSplitting<Scalar, Dim>> make_splitting(double penalty, bool half,
                                                               ActiveLists active) const;
  int grow(const Milestone& at);

  const LbcProblem<Dim>& problem_;
  const splitting::Metric metric_;
  const Parameters parameters_;
  std::unique_ptr<ActiveSplitting<Scalar, Dim>> splitting_;
  splitting::PenaltyRule rule_;
  int since_ = 0;  // iteration of the last change or check
  int growths_ = 0;
};

}  // namespace flbc::active_set
