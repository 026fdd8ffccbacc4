// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/deform.h"

#include "support/errors.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

WeightMatrix stochastic(Index rows, Index columns) {
  WeightMatrix weights = WeightMatrix::Random(rows, columns).cwiseAbs();
  for (Index p = 0; p < columns; ++p) weights.col(p) /= weights.col(p).sum();
  return weights;
}

TEST(ComposeTest, IsTheProduct) {
  const auto weights = stochastic(5, 40);
  auto map = stochastic(3, 5);
  map(0, 1) = 0;
  map.col(1) /= map.col(1).sum();
  const auto product = compose(weights, map);
  EXPECT_EQ(product.num_control_points(), 3);
  EXPECT_LT((product.dense() - map * weights).norm(), 1e-14);
  EXPECT_LT((product.dense().colwise().sum().array() - 1).abs().maxCoeff(), 1e-14);
}

TEST(ComposeTest, OtherMapsAreRefused) {
  const auto weights = stochastic(5, 2);
  expect_refused("the weights are for 5 control points, but the map has weights of 4",
                 [&] { compose(weights, stochastic(3, 4)); });
  auto map = stochastic(3, 5);
  map(1, 2) += 1e-6;
  expect_refused("the weights of control point 2 in the map sum to 1",
                 [&] { compose(weights, map); });
  map = stochastic(3, 5);
  map.col(4) << -0.5, 1, 0.5;
  expect_refused("control point 4 the weight -0.5", [&] { compose(weights, map); });
}

}  // namespace
}  // namespace flbc::testing
