// SPDX-License-Identifier: BSD-3-Clause
#include "polytope/small_lu.h"

#include "support/test.h"

namespace flbc::testing {
namespace {

template <class Size>
class SmallLuTest : public ::testing::Test {};
using Sizes = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>,
                               std::integral_constant<int, 4>>;
TYPED_TEST_SUITE(SmallLuTest, Sizes);

TYPED_TEST(SmallLuTest, SolvesAsEigenDoes) {
  constexpr int kSize = TypeParam::value;
  using Lu = SmallLu<kSize>;
  std::srand(1);
  for (int k = 0; k < 100; ++k) {
    typename Lu::Square matrix = Lu::Square::Random();
    if (k % 2 == 0) matrix(0, 0) = 0;  // needs a pivot
    const typename Lu::Column b = Lu::Column::Random();
    Lu lu;
    lu.compute(matrix);
    const Eigen::FullPivLU<typename Lu::Square> expected(matrix);
    const double tolerance = 1e-13 / expected.rcond();
    EXPECT_LT((lu.solve(b) - expected.solve(b)).norm(), tolerance);
    EXPECT_LT((lu.solve_transposed(b) -
               Eigen::FullPivLU<typename Lu::Square>(matrix.transpose()).solve(b))
                  .norm(),
              tolerance);
  }
}

TYPED_TEST(SmallLuTest, ASingularMatrixHasNoFiniteSolution) {
  using Lu = SmallLu<TypeParam::value>;
  typename Lu::Square matrix = Lu::Square::Identity();
  matrix.row(0) = matrix.row(1);
  Lu lu;
  lu.compute(matrix);
  EXPECT_FALSE(lu.solve(Lu::Column::Unit(0)).allFinite());
  EXPECT_FALSE(lu.solve_transposed(Lu::Column::Unit(0)).allFinite());
}

}  // namespace
}  // namespace flbc::testing
