// SPDX-License-Identifier: BSD-3-Clause
#include "problem/geodesic/interpolated_distances.h"

#include "flbc/nested_mesh.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

// Distances at the vertices of a refined sample: interpolated from the sample, and exact.
template <int Dim>
struct Comparison {
  Sample<Dim> fine;
  DistanceMatrix interpolated;
  DistanceMatrix exact;

  Comparison(Shape shape, int resolution) : fine(make_sample<Dim>(shape, resolution, 0.2)) {
    const auto known = distances_on(fine, build_topology(fine.mesh));
    fine.mesh = refine(fine.mesh);
    interpolated = interpolated_distances<Dim>(fine.cage.points, fine.mesh.points,
                                               coarse_mesh(fine.mesh)->ends, known);
    exact = distances_on(fine, build_topology(fine.mesh));
  }

  static DistanceMatrix distances_on(const Sample<Dim>& sample, const MeshTopology<Dim>& topology) {
    const auto sources = boundary_values(sample.cage, sample.mesh, topology).control_vertices;
    return geodesic_distances(sample.mesh, topology, sources);
  }

  double size() const { return bounding_box_diagonal(fine.cage.points); }
};

TEST_IN_2D_AND_3D(InterpolatedDistancesTest, LoseNothingWhereWaysAreStraight) {
  const Comparison<Dim> box(Shape::kBox, 2);
  EXPECT_LT((box.interpolated - box.exact).cwiseAbs().maxCoeff(), 2e-5 * box.size());
}

TEST_IN_2D_AND_3D(InterpolatedDistancesTest, ApproachExactOnesAsTheMeshIsRefined) {
  for (const auto shape : {Shape::kCorner, Shape::kRing}) {
    const auto error = [&](int resolution) {
      const Comparison<Dim> c(shape, resolution);
      EXPECT_GE((c.interpolated - c.exact).minCoeff(), -0.05 * c.size());
      return (c.interpolated - c.exact).norm() / c.exact.norm();
    };
    const double coarse = error(2);
    EXPECT_LT(coarse, 0.05);
    EXPECT_LT(error(4), coarse);
  }
}

}  // namespace
}  // namespace flbc::testing
