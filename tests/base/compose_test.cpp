// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/deform.h"

#include <algorithm>

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

// A bone is a control point that others follow: its weights are those of compose().
TEST(SkinTest, IsTheProductAndKeepsTheLargest) {
  auto weights = stochastic(5, 40);
  weights.col(7).setZero();  // outside of the cage, does not move
  const auto bones = stochastic(6, 5);
  const WeightMatrix product = bones * weights;
  EXPECT_LT((skin(weights, bones).dense() - product).norm(), 1e-14);
  for (const Index most : {1, 4, 6, 9}) {
    const auto few = skin(weights, bones, most);
    EXPECT_FALSE(few.has_weights(7));
    for (Index p = 0; p < 40; ++p) {
      if (p == 7) continue;
      EXPECT_EQ(few.count(p), std::min<Index>(most, 6));
      EXPECT_NEAR(few.at(p).sum(), 1, 1e-15);
      double smallest_kept = 1, largest_dropped = 0, kept = 0;
      for (Index b = 0; b < 6; ++b) {
        if (few.at(p)[b] == 0) largest_dropped = std::max(largest_dropped, product(b, p));
        if (few.at(p)[b] != 0) smallest_kept = std::min(smallest_kept, product(b, p));
        if (few.at(p)[b] != 0) kept += product(b, p);
      }
      EXPECT_GE(smallest_kept, largest_dropped);
      for (Index b = 0; b < 6; ++b) {
        EXPECT_NEAR(few.at(p)[b], few.at(p)[b] == 0 ? 0 : product(b, p) / kept, 1e-15);
      }
    }
  }
}

TEST(SkinTest, EqualAndNegativeWeights) {
  // Two bones alike: one is kept. A vertex outside of the cage may have negative weights.
  WeightMatrix weights(2, 2), bones(3, 2);
  weights << 1, 1.5, 0, -0.5;
  bones << 0.5, 0, 0.5, 0, 0, 1;
  const auto found = skin(weights, bones, 1).dense();
  EXPECT_EQ(found.col(0).maxCoeff(), 1);
  EXPECT_EQ(found.col(0).head(2).sum(), 1);
  EXPECT_EQ(skin(weights, bones).dense().col(1), Eigen::Vector3d(0.5, 0.5, 0));
}

TEST(SkinTest, OtherBonesAreRefused) {
  const auto weights = stochastic(5, 2);
  expect_refused("the weights are for 5 control points", [&] { skin(weights, stochastic(3, 4)); });
  const Eigen::MatrixXf single = stochastic(3, 5).cast<float>();
  EXPECT_NO_THROW(skin(weights, single.cast<double>()));
  auto bones = stochastic(3, 5);
  bones(1, 2) += 1e-4;
  expect_refused("the weights of control point 2", [&] { skin(weights, bones); });
  bones(0, 1) = -0.1;
  expect_refused("control point 1 the weight -0.1", [&] { skin(weights, bones); });
  EXPECT_THROW(skin(weights, stochastic(3, 5), -1), OptionError);
}

}  // namespace
}  // namespace flbc::testing
