// SPDX-License-Identifier: BSD-3-Clause
// Public functions with damaged arguments return or throw flbc::Error. flbc_mutations makes more
// such calls under sanitizers (scripts/fuzz.sh).
#include <gtest/gtest.h>

#include "fuzz/mutations.h"

namespace flbc::testing {
namespace {

constexpr std::uint32_t kCalls = 100;

class FuzzMutations : public ::testing::TestWithParam<fuzz::Call> {};

TEST_P(FuzzMutations, AreAcceptedOrRefused) {
  fuzz::Counts counts{};
  std::uint32_t accepted = 0;
  for (std::uint32_t seed = 0; seed < kCalls && !HasFailure(); ++seed) {
    try {
      if (fuzz::accepts(GetParam(), seed, counts)) ++accepted;
    } catch (const std::exception& error) {
      ADD_FAILURE() << "seed " << seed << ": " << error.what();
    }
  }
  EXPECT_TRUE(accepted > 0 && accepted < kCalls) << accepted << " of " << kCalls;
}

INSTANTIATE_TEST_SUITE_P(Calls, FuzzMutations, ::testing::ValuesIn(fuzz::all_calls()),
                         [](const auto& call) { return call.param.name; });

}  // namespace
}  // namespace flbc::testing
