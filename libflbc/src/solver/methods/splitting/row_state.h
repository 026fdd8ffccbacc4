// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The state of a splitting at the vertices, in flat arrays: all control points of each row, or
//! those of its list in an active set.
#pragma once

#include "base/aligned_array.h"
#include "base/parallel.h"

namespace flbc::splitting {

//! The arrays of compact_splitting.h, in its notation and units. Interior rows come first.
template <class Scalar>
struct RowState {
  AlignedArray<Scalar> a;               // of all rows
  AlignedArray<Scalar> W, S, residual;  // of interior rows; S is empty if w may be negative
  AlignedArray<Scalar> difference;      // w - W of all rows, where measured

  RowState() = default;
  RowState(std::size_t all, std::size_t interior, bool non_negative)
      : a(all), W(interior), S(non_negative ? interior : 0), residual(interior) {}

  std::size_t size() const { return a.size() + W.size() + S.size() + residual.size(); }

  //! Lets the loops begin at one of the numbers.
  template <class Arrays>
  void set(Arrays& arrays, std::size_t first = 0) {
    arrays.extrapolated = a.data() + first;
    arrays.relaxed = W.data() + first;
    arrays.vertex_dual = S.size() > 0 ? S.data() + first : nullptr;
    arrays.residual = residual.data() + first;
  }

  //! Calls step() without S, whose w_step for the next iteration waits.
  template <class Step>
  auto without_dual(const Step& step) {
    AlignedArray<Scalar> none;
    std::swap(S, none);
    const auto result = step();
    std::swap(S, none);
    return result;
  }

  //! Sets w - W, which is (a - W) / 2.
  void set_difference() {
    if (difference.size() == 0) difference = AlignedArray<Scalar>(a.size());
    parallel_for(W.size(), [&](std::size_t k) { difference[k] = Scalar(0.5) * (a[k] - W[k]); });
  }

  //! w of interior rows.
  AlignedArray<Scalar> w() const {
    AlignedArray<Scalar> w(W.size());
    parallel_for(w.size(), [&](std::size_t k) { w[k] = Scalar(0.5) * (a[k] + W[k]); });
    return w;
  }

  //! The change of w since `before`, of all rows.
  AlignedArray<Scalar> moved(const AlignedArray<Scalar>& before) const {
    AlignedArray<Scalar> moved(a.size());
    parallel_for(W.size(),
                 [&](std::size_t k) { moved[k] = Scalar(0.5) * (a[k] + W[k]) - before[k]; });
    return moved;
  }

  //! sigma (q - w)
  double vertex_dual(std::size_t k) const {
    const double twice = static_cast<double>(a[k]) - static_cast<double>(W[k]);
    return S[k] - 0.5 * twice;
  }
};

}  // namespace flbc::splitting
