// SPDX-License-Identifier: BSD-3-Clause
#include "problem/geodesic/bounded_distances.h"

#include "flbc/lbc_problem.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

template <int Dim>
struct BoundedDistancesTest {
  BoundedDistancesTest()
      : sample(make_sample<Dim>(Shape::kRing, Dim == 2 ? 16 : 5, 0.2)),
        topology(build_topology(sample.mesh)),
        sources(boundary_values(sample.cage, sample.mesh, topology).control_vertices),
        exact(geodesic_distances(sample.mesh, topology, sources)) {}

  // Vertices within a part of the largest distance, by source.
  VertexItems<Index> within(double part) const {
    return items_by_vertex<Index>(static_cast<Index>(sources.size()), [&](const auto& visit) {
      for (Index i = 0; i < exact.rows(); ++i) {
        for (Index v = 0; v < exact.cols(); ++v) {
          if (exact(i, v) <= part * exact.maxCoeff()) visit(i, v);
        }
      }
    });
  }
  BoundedDistances bounded(const VertexItems<Index>& needed) const {
    return bounded_distances(sample.mesh, topology, sources, needed);
  }
  double rounding() const { return 1e-6 * bounding_box_diagonal(sample.cage.points); }

  const Sample<Dim> sample;
  const MeshTopology<Dim> topology;
  const std::vector<Index> sources;
  const DistanceMatrix exact;
};

TEST_IN_2D_AND_3D(BoundedDistancesTest, AreExactWhereTheyAreNeededAndNeverTooLong) {
  BoundedDistancesTest<Dim> t;
  const auto needed = t.within(0.3);
  const auto bounded = t.bounded(needed);
  Index beyond = 0;
  for (Index i = 0; i < t.exact.rows(); ++i) {
    for (const Index v : needed.of(i)) {
      EXPECT_LE(t.exact(i, v), bounded.reach[i] + t.rounding());
    }
    for (Index v = 0; v < t.exact.cols(); ++v) {
      const float exact = t.exact(i, v);
      EXPECT_LE(bounded.distances(i, v), exact + t.rounding());
      if (exact < bounded.reach[i] - t.rounding()) {
        EXPECT_NEAR(bounded.distances(i, v), exact, t.rounding());
      } else {
        EXPECT_GE(bounded.distances(i, v), bounded.reach[i] - t.rounding());
        ++beyond;
      }
    }
  }
  EXPECT_GT(beyond, t.exact.size() / 4);
}

// Phi is relative to it.
TEST_IN_2D_AND_3D(BoundedDistancesTest, HaveNearlyTheLargestDistance) {
  BoundedDistancesTest<Dim> t;
  const auto bounded = t.bounded(t.within(0.1));
  EXPECT_GE(bounded.distances.maxCoeff(), 0.98f * t.exact.maxCoeff());
  EXPECT_EQ((bounded.reach.array() == INFINITY).count(),
            std::min<Index>(4, static_cast<Index>(t.exact.rows())));
}

TEST_IN_2D_AND_3D(BoundedDistancesTest, AreAllThereIfAllAreNeeded) {
  BoundedDistancesTest<Dim> t;
  const auto bounded = t.bounded(t.within(1));
  EXPECT_EQ(bounded.distances, t.exact);
  EXPECT_TRUE((bounded.reach.array() == INFINITY).all());
}

TEST_IN_2D_AND_3D(BoundedDistancesTest, AreTheSameForAnyNumberOfThreads) {
  BoundedDistancesTest<Dim> t;
  expect_same_for_any_threads([&] { return t.bounded(t.within(0.3)).distances; });
}

}  // namespace
}  // namespace flbc::testing
