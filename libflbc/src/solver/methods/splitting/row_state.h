// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The state of a splitting at the vertices, in flat arrays: all control points of each row, or
//! those of its list in an active set.
#pragma once

#include <algorithm>

#include "base/aligned_array.h"
#include "base/parallel.h"

namespace flbc::splitting {

//! The arrays of compact_splitting.h, in its notation and units. Interior rows come first.
template <class Scalar>
struct RowState {
  AlignedArray<Scalar> a;               // of all rows
  AlignedArray<Scalar> W, S, residual;  // of interior rows; S is empty if w may be negative
  AlignedArray<Scalar> difference;      // w - W of all rows, where measured
  AlignedArray<Scalar> start;           // w at the start of interior rows, while it is needed

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

  //! Calls step() with S for the w_step of the next iteration. If that waits for another penalty, a
  //! measured step takes a copy of S, and others leave it out.
  template <class Step>
  auto with_dual(bool waits, bool measured, const Step& step) {
    if (!waits) return step();
    AlignedArray<Scalar> other(measured ? S.size() : 0);
    std::copy_n(S.data(), other.size(), other.data());
    std::swap(S, other);
    const auto result = step();
    std::swap(S, other);
    return result;
  }

  //! Sets w - W, which is (a - W) / 2.
  void set_difference() {
    if (difference.size() == 0) difference = AlignedArray<Scalar>(a.size());
    parallel_for(W.size(), [&](std::size_t k) { difference[k] = Scalar(0.5) * (a[k] - W[k]); });
  }

  //! Begins to measure the motion of w.
  void keep_start() {
    start = AlignedArray<Scalar>(W.size());
    std::copy_n(a.data(), start.size(), start.data());
  }

  //! The motion of w since then, of all rows. Sets w - W.
  AlignedArray<Scalar> moved() {
    set_difference();
    AlignedArray<Scalar> moved(a.size());
    parallel_for(W.size(), [&](std::size_t k) { moved[k] = a[k] - difference[k] - start[k]; });
    return moved;
  }

  //! Another penalty: in the units of the arrays the duals do not change, and w changes with sigma.
  //! The step w - W belongs to the duals. \param factor  of sigma
  void scale_interior(Scalar factor) {
    set_difference();
    parallel_for(W.size(), [&](std::size_t k) {
      const Scalar w = factor * (a[k] - difference[k]);
      W[k] = w - difference[k];
      a[k] = w + difference[k];
    });
    parallel_for(start.size(), [&](std::size_t k) { start[k] *= factor; });
  }

  //! sigma (q - w)
  double vertex_dual(std::size_t k) const {
    const double twice = static_cast<double>(a[k]) - static_cast<double>(W[k]);
    return S[k] - 0.5 * twice;
  }
};

}  // namespace flbc::splitting
