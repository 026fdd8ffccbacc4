// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Memory of an iteration's state (flbc/solver_state.h).
#pragma once

#include <algorithm>
#include <map>

#include "base/aligned_array.h"
#include "flbc/solver_state.h"

namespace flbc {

//! Allocates a state array, from the caller's StateStorage if given; zero unless that holds the
//! state of an earlier run.
template <class Scalar>
AlignedArray<Scalar> state_array(StateStorage* storage, StateArray array, std::size_t elements,
                                 std::size_t components, std::size_t stride) {
  const std::size_t size = elements * components * stride;
  if (storage == nullptr) return AlignedArray<Scalar>(size);
  const auto precision = sizeof(Scalar) == 2               ? Precision::kHalf
                         : sizeof(Scalar) == sizeof(float) ? Precision::kSingle
                                                           : Precision::kDouble;
  auto* data =
      static_cast<Scalar*>(storage->allocate({array, elements, components, stride, precision}));
  if (storage->penalty() == 0) std::fill_n(data, size, Scalar{});
  return AlignedArray<Scalar>::borrow(data, size);
}

//! State that outlives its run, so that the next one goes on from it.
class KeptState : public StateStorage {
 public:
  void* allocate(const StateShape& shape) override {
    const std::size_t bytes = shape.precision == Precision::kHalf     ? 2
                              : shape.precision == Precision::kSingle ? sizeof(float)
                                                                      : sizeof(double);
    const std::size_t size = shape.elements * shape.components * shape.stride * bytes;
    if (shape.array == StateArray::kSplittingState) splitting_precision_ = shape.precision;
    auto& array = arrays_[shape.array];
    if (array.size() != size) array = AlignedArray<unsigned char>(size);
    return array.data();
  }

  // A run that went on in single precision is not gone on from in half.
  bool holds_half() const override {
    return penalty_ == 0 || splitting_precision_ == Precision::kHalf;
  }
  double penalty() const override { return penalty_; }
  void keep_penalty(double penalty) override { penalty_ = penalty; }

  //! The next run starts afresh.
  void forget() { penalty_ = 0; }

 private:
  std::map<StateArray, AlignedArray<unsigned char>> arrays_;
  Precision splitting_precision_ = Precision::kHalf;
  double penalty_ = 0;
};

//! Whether there is a state to go on from.
inline bool resumes(const StateStorage* storage) {
  return storage != nullptr && storage->penalty() > 0;
}

}  // namespace flbc
