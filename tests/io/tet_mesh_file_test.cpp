// SPDX-License-Identifier: BSD-3-Clause
// Files of tetrahedral meshes.
#include "format_test.h"

namespace flbc::testing {
namespace {

class TetMeshFile : public FormatTest {
 protected:
  static void expect_equal(const DomainMesh<3>& a, const DomainMesh<3>& b) {
    EXPECT_TRUE(bit_equal(a.points, b.points));
    EXPECT_EQ(a.cells, b.cells);
  }
};

TEST_F(TetMeshFile, BothVersionsOfGmsh) {
  const DomainMesh<3> mesh = awkward_mesh<3>();
  io::write_domain<3>(path("2.msh"), mesh);
  EXPECT_EQ(content("2.msh").substr(0, 16), "$MeshFormat\n2.2 ");
  expect_equal(io::read_domain<3>(path("2.msh")), mesh);

  // Two blocks of nodes, the tags of which are not in order.
  make("4.msh",
       "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n1 0 0 0 1 1 1 0 0\n$EndEntities\n"
       "$Nodes\n2 4 1 4\n3 1 0 3\n1\n2\n4\n0 0 0\n1 0 0\n0 0 1\n3 1 0 1\n3\n0 1 0\n$EndNodes\n"
       "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n");
  Eigen::Matrix<double, 3, 4> points;
  points << 0, 1, 0, 0,  //
      0, 0, 0, 1,        //
      0, 0, 1, 0;
  expect_equal(io::read_domain<3>(path("4.msh")),
               {points, CellList<3>(Eigen::Vector4i(0, 1, 3, 2))});
}

}  // namespace
}  // namespace flbc::testing
