// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include "base/parallel.h"

namespace flbc::testing {

//! The result of `run` has the same bits with one thread and with several.
template <class Run>
void expect_same_for_any_threads(const Run& run) {
  const auto with = [&](int threads) {
    const ThreadScope scope(threads);
    return run();
  };
  const auto one = with(1);
  for (const int threads : {2, 3, 5}) EXPECT_TRUE(with(threads) == one) << threads << " threads";
}

}  // namespace flbc::testing
