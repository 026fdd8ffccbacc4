// SPDX-License-Identifier: BSD-3-Clause
// Who fills a cage with cells: the second mesher where the first one fails.
#include "support/command_line.h"

namespace flbc::testing {
namespace {

class MesherCommand : public CommandLineTest {
 protected:
  // Too thin for cells of good shape.
  std::string flat_box() const {
    return file("flat.obj",
                "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 0.0005\nv 1 0 0.0005\nv 0 1 0.0005\n"
                "v 1 1 0.0005\nf 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n");
  }
  static bool has_netgen() { return FLBC_HAS_NETGEN != 0; }
};

TEST_F(MesherCommand, NetgenMeshesWhatTetgenCannot) {
  const auto solve =
      "solve " + flat_box() + " --vertices 200 --mesh-timeout 4 -o w.npy --report report.json";
  const auto refused = expect(solve + " --mesher tetgen", 2, "TetGen");
  EXPECT_FALSE(std::filesystem::exists("w.npy"));
  if (!has_netgen()) GTEST_SKIP() << "built without Netgen";
  expect_piece(refused.errors, "--mesher netgen");
  for (const std::string mesher : {"", " --mesher netgen"}) {
    const auto solved = expect(solve + mesher);
    const auto report = json_in("report.json");
    EXPECT_EQ(report["mesher"], "netgen");
    const bool is_second = mesher != " --mesher netgen";
    EXPECT_EQ(solved.errors.find("the mesh was made by netgen") != std::string::npos, is_second)
        << solved.errors;
    const auto weights = io::read_weights("w.npy").dense();
    EXPECT_NEAR(weights.colwise().sum().minCoeff(), 1, 1e-12);
    EXPECT_NEAR(weights.colwise().sum().maxCoeff(), 1, 1e-12);
    EXPECT_GE(weights.minCoeff(), 0);
  }
}

TEST_F(MesherCommand, SoundCagesAreMeshedByTheFirst) {
  expect("run 3d/limb_cage.obj --vertices 1000 -q -o out");
  const auto report = json_in("out/report.json");
  EXPECT_EQ(report["solve"]["mesher"], "tetgen");
  EXPECT_EQ(report["mesh"]["mesher"], "tetgen");
}

TEST_F(MesherCommand, MeshersOfTheOtherDimensionAreRefused) {
  expect("mesh 3d/limb_cage.obj --mesher cgal -o m.mesh", 1,
         "--mesher cgal: this mesher does not support 3D");
  expect("mesh 2d/ring_cage.obj --mesher tetgen -o m.obj", 1);
  expect("mesh 2d/ring_cage.obj --mesher x -o m.obj", 1);
}

}  // namespace
}  // namespace flbc::testing
