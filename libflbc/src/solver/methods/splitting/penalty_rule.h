// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! When and how a splitting adapts its penalty, on all pairs or on an active set.
#pragma once

namespace flbc::splitting {

//! What adapts the penalty after an iteration.
enum class Due { kNothing, kBalance, kLook };

//! Squared norms in the metric, over all cells: of the dual z-step argument, and of the change of
//! gradients since the start.
struct BalanceLengths {
  double dual2, motion2;
};

//! Adapts a penalty twice. In the first iterations after a cold start, it balances the duals
//! against the change of the weights. Later it looks at the residuals: weights in thin parts and
//! slits creep long after the rest has settled. There the constraints are violated little for the
//! speed of the weights, and a smaller penalty lets them move on. Constants: plan/constants.h.
class PenaltyRule {
 public:
  //! \param balances, looks  whether it does so at all
  //! \param smoothness  of the problem; with smoothness, runs end before looks would matter
  //! \param part  factor of balanced penalties, for an active set
  PenaltyRule(bool balances, bool looks, double smoothness, double part = 1);

  //! What is due after iteration `made`, counted from the start.
  Due due(int made) const;

  //! The balanced penalty: a multiple of penalty |dual| / |motion|, at most a constant, plus a
  //! multiple of the smoothness.
  double balanced(double penalty, const BalanceLengths& lengths) const;

  //! The penalty after a look. \param ratio  r_p / r_d of the gradients
  double after_look(int made, double penalty, double ratio);

  //! Iterations to make until the weights have followed a lowered penalty.
  int to_make(int made) const { return settled_ > made ? settled_ - made : 0; }

 private:
  bool balances_;
  double smoothness_;
  double part_;
  int next_look_;    // iteration; 0 = never
  int settled_ = 0;  // iteration in which a lowered penalty has taken effect
};

}  // namespace flbc::splitting
