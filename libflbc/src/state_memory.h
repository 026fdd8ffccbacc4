// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Arrays of an iteration's state: the caller's where there is a storage, of one's own otherwise.
#pragma once

#include <algorithm>

#include "aligned_array.h"
#include "flbc/solver_state.h"

namespace flbc {

template <class Scalar>
AlignedArray<Scalar> state_array(StateStorage* storage, StateArray array, std::size_t elements,
                                 std::size_t components, std::size_t stride) {
  const std::size_t size = elements * components * stride;
  if (storage == nullptr) return AlignedArray<Scalar>(size);
  const auto precision = sizeof(Scalar) == sizeof(float) ? Precision::kSingle : Precision::kDouble;
  auto* data =
      static_cast<Scalar*>(storage->allocate({array, elements, components, stride, precision}));
  if (storage->penalty() == 0) std::fill_n(data, size, Scalar(0));
  return AlignedArray<Scalar>::borrow(data, size);
}

}  // namespace flbc
