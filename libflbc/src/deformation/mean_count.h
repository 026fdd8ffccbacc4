// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "flbc/types.h"

namespace flbc {

//! The mean of counts, whose sum may exceed the range of Index. 0 without counts.
class MeanCount {
 public:
  void add(Index count) {
    sum_ += count;
    ++number_;
  }
  double value() const {
    return number_ == 0 ? 0 : static_cast<double>(sum_) / static_cast<double>(number_);
  }

 private:
  std::int64_t sum_ = 0, number_ = 0;
};

}  // namespace flbc
