// SPDX-License-Identifier: BSD-3-Clause
// Solves that run out of memory, also within parallel loops, end in a result or an exception.
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <optional>

#include <gtest/gtest.h>

#include "flbc/errors.h"
#include "flbc/solver.h"
#include "support/dimensions.h"
#include "support/sample_meshes.h"

namespace {

constexpr std::int64_t kPlenty = std::int64_t(1) << 60;
std::atomic<std::int64_t> allocations_left{kPlenty};

bool is_refused() {
  return allocations_left.fetch_sub(1, std::memory_order_relaxed) <= 0;
}

}  // namespace

// The linker redirects the calls of the library (--wrap). Shared libraries are not affected.
extern "C" {
void* __real_malloc(std::size_t);
void* __real_calloc(std::size_t, std::size_t);
void* __wrap_malloc(std::size_t size) {
  return is_refused() ? nullptr : __real_malloc(size);
}
void* __wrap_calloc(std::size_t count, std::size_t size) {
  return is_refused() ? nullptr : __real_calloc(count, size);
}
}

void* operator new(std::size_t size) {
  void* const block = is_refused() ? nullptr : __real_malloc(size > 0 ? size : 1);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}
void operator delete(void* block) noexcept {
  std::free(block);
}
void operator delete(void* block, std::size_t) noexcept {
  std::free(block);
}

namespace flbc::testing {
namespace {

// \return the number of allocations, none if they do not suffice
template <int Dim>
std::optional<std::int64_t> solve_with(std::int64_t allocations, const Sample<Dim>& sample,
                                       const SolverOptions& options) {
  struct Limit {
    explicit Limit(std::int64_t limit) { allocations_left = limit; }
    ~Limit() { allocations_left = kPlenty; }
  };
  try {
    const Limit limit(allocations);
    solve(sample.cage, sample.mesh, options);
    return allocations - allocations_left;
  } catch (const std::bad_alloc&) {
  } catch (const Error&) {  // of libraries that ran out of memory
  }
  return {};
}

TEST_IN_2D_AND_3D(AllocationFailure, EndsInAResultOrAnException) {
  constexpr int kTries = 40;
  const auto sample = make_sample<Dim>(Shape::kCorner, Dim == 2 ? 12 : 6, 0.2);
  SolverOptions options;
  options.threads = 3;
  options.max_iterations = 3;
  for (const auto method : {Method::kWeights, Method::kGradient, Method::kPaper}) {
    for (const bool active : {false, true}) {
      options.method = method;
      options.active_set = active && method == Method::kWeights ? ActiveSet::kOn : ActiveSet::kAuto;
      const auto needed = solve_with(kPlenty, sample, options);
      ASSERT_GT(needed.value_or(0), 100);
      for (int k = 0; k < kTries; ++k) {
        const bool is_solved = solve_with(*needed * k / kTries, sample, options).has_value();
        EXPECT_FALSE(is_solved && k < kTries / 2);
      }
    }
  }
}

}  // namespace
}  // namespace flbc::testing
