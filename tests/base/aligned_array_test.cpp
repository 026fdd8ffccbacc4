// SPDX-License-Identifier: BSD-3-Clause
#include "base/aligned_array.h"

#include "support/test.h"

namespace flbc {
namespace {

TEST(AlignedArrayTest, IsZeroAlignedAndMovesAsAWhole) {
  for (const std::size_t size : {0, 1, 1000}) {
    AlignedArray<float> array(size);
    ASSERT_EQ(array.size(), size);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(array.data()) % 64, 0u);
    EXPECT_TRUE(std::all_of(array.data(), array.data() + size, [](float x) { return x == 0; }));
    const float* const data = array.data();
    AlignedArray<float> moved(std::move(array));
    AlignedArray<float> assigned(7);
    assigned = std::move(moved);
    EXPECT_EQ(assigned.data(), data);
    EXPECT_EQ(assigned.size(), size);
    for (const auto* left : {&array, &moved}) {  // of which nothing may be read
      EXPECT_EQ(left->size(), 0u);
      EXPECT_EQ(left->data(), nullptr);
    }
  }
}

}  // namespace
}  // namespace flbc
