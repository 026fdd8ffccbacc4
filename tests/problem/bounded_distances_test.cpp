// SPDX-License-Identifier: BSD-3-Clause
#include "problem/geodesic/bounded_distances.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "flbc/bounding_box.h"
#include "flbc/lbc_problem.h"
#include "support/sample_meshes.h"

namespace flbc::testing {
namespace {

template <class Dimension>
class BoundedDistancesTest : public ::testing::Test {
 protected:
  static constexpr int kDimension = Dimension::value;

  BoundedDistancesTest()
      : sample_(make_sample<kDimension>(Shape::kRing, kDimension == 2 ? 16 : 5, 0.2)),
        topology_(build_topology(sample_.mesh)),
        sources_(boundary_values(sample_.cage, sample_.mesh, topology_).control_vertices),
        exact_(geodesic_distances(sample_.mesh, topology_, sources_)) {}

  // Vertices within a part of the largest distance, by source.
  VertexItems<Index> within(double part) const {
    return items_by_vertex<Index>(static_cast<Index>(sources_.size()), [&](const auto& visit) {
      for (Index i = 0; i < exact_.rows(); ++i) {
        for (Index v = 0; v < exact_.cols(); ++v) {
          if (exact_(i, v) <= part * exact_.maxCoeff()) visit(i, v);
        }
      }
    });
  }
  BoundedDistances bounded(const VertexItems<Index>& needed) const {
    return bounded_distances(sample_.mesh, topology_, sources_, needed);
  }
  double rounding() const { return 1e-6 * bounding_box_diagonal(sample_.cage.points); }

  const Sample<kDimension> sample_;
  const MeshTopology<kDimension> topology_;
  const std::vector<Index> sources_;
  const DistanceMatrix exact_;
};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(BoundedDistancesTest, Dimensions);

TYPED_TEST(BoundedDistancesTest, AreExactWhereTheyAreNeededAndNeverTooLong) {
  const auto needed = this->within(0.3);
  const auto bounded = this->bounded(needed);
  Index beyond = 0;
  for (Index i = 0; i < this->exact_.rows(); ++i) {
    for (const Index v : needed.of(i)) {
      EXPECT_LE(this->exact_(i, v), bounded.reach[i] + this->rounding());
    }
    for (Index v = 0; v < this->exact_.cols(); ++v) {
      const float exact = this->exact_(i, v);
      EXPECT_LE(bounded.distances(i, v), exact + this->rounding());
      if (exact < bounded.reach[i] - this->rounding()) {
        EXPECT_NEAR(bounded.distances(i, v), exact, this->rounding());
      } else {
        EXPECT_GE(bounded.distances(i, v), bounded.reach[i] - this->rounding());
        ++beyond;
      }
    }
  }
  EXPECT_GT(beyond, this->exact_.size() / 4);
}

// Phi is relative to it.
TYPED_TEST(BoundedDistancesTest, HaveNearlyTheLargestDistance) {
  const auto bounded = this->bounded(this->within(0.1));
  EXPECT_GE(bounded.distances.maxCoeff(), 0.98f * this->exact_.maxCoeff());
  EXPECT_EQ((bounded.reach.array() == INFINITY).count(),
            std::min<Index>(4, static_cast<Index>(this->exact_.rows())));
}

TYPED_TEST(BoundedDistancesTest, AreAllThereIfAllAreNeeded) {
  const auto bounded = this->bounded(this->within(1));
  EXPECT_EQ(bounded.distances, this->exact_);
  EXPECT_TRUE((bounded.reach.array() == INFINITY).all());
}

TYPED_TEST(BoundedDistancesTest, AreTheSameForAnyNumberOfThreads) {
  const auto with = [&](int threads) {
    const ThreadScope scope(threads);
    return this->bounded(this->within(0.3)).distances;
  };
  EXPECT_EQ(with(1), with(5));
}

}  // namespace
}  // namespace flbc::testing
