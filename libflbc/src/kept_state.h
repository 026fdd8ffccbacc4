// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Memory in which an iteration's state outlives its run, so that the next one goes on from it.
#pragma once

#include <map>

#include "aligned_array.h"
#include "flbc/solver_state.h"

namespace flbc {

class KeptState : public StateStorage {
 public:
  void* allocate(const StateShape& shape) override {
    const std::size_t bytes =
        shape.precision == Precision::kSingle ? sizeof(float) : sizeof(double);
    const std::size_t size = shape.elements * shape.components * shape.stride * bytes;
    auto& array = arrays_[shape.array];
    if (array.size() != size) array = AlignedArray<unsigned char>(size);
    return array.data();
  }

  double penalty() const override { return penalty_; }
  void keep_penalty(double penalty) override { penalty_ = penalty; }

  //! The next run starts afresh.
  void forget() { penalty_ = 0; }

 private:
  std::map<StateArray, AlignedArray<unsigned char>> arrays_;
  double penalty_ = 0;
};

}  // namespace flbc
