// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/vertex_count_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace flbc::testing {
namespace {

DomainMesh<3> of_vertices(double count) {
  DomainMesh<3> mesh;
  mesh.points = PointList<3>::Zero(3, static_cast<Eigen::Index>(count));
  return mesh;
}

// A mesher whose counts level off: thin parts need 500 vertices at any volume.
TEST(VertexCountSearch, MeshesStaySmallWhereCountsLevelOff) {
  for (const double first : {1.0, 30.0, 0.01}) {
    std::vector<double> counts;
    const auto found =
        search_vertex_count<3>({1000, 0.02}, of_vertices(8), first, 1, [&](double volume) {
          counts.push_back(std::max(500.0, 100 / volume));
          return of_vertices(counts.back());
        });
    EXPECT_NEAR(found.num_vertices(), 1000, 20) << first;
    EXPECT_LE(counts.size(), 10U) << first;
    EXPECT_LE(*std::max_element(counts.begin() + 1, counts.end()), 4000) << first;
  }
}

}  // namespace
}  // namespace flbc::testing
