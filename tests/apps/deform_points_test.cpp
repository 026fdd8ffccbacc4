// SPDX-License-Identifier: BSD-3-Clause
// flbc deform with files of points.
#include "flbc/io/mesh_io.h"
#include "support/command_line.h"

namespace flbc::testing {
namespace {

// Points in a tetrahedron.
class DeformPoints : public CommandLineTest {
 protected:
  static constexpr Index kPoints = 300;

  void SetUp() override {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> part(0, 1.0 / 3);
    points_.resize(3, kPoints);
    for (double& number : points_.reshaped()) number = part(random);
    io::write_weights("p.npy", points_);
    const PointList<3> corners = PointList<3>{{0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    io::write_domain<3>("domain.mesh", {corners, CellList<3>{{0}, {1}, {2}, {3}}});
    rig_ = " --domain domain.mesh --weights " + linear_weights(corners) + " --rest " +
           tetrahedron() + " --pose " +
           tetrahedron("v 1 0 0\nv 3 0 0\nv 1 3 0\nv 1 0 4\n", "pose.obj") + ' ';
  }

  // Where the pose puts them.
  static WeightMatrix moved(const WeightMatrix& points) {
    WeightMatrix result = Vector<3>(2, 3, 4).asDiagonal() * points;
    result.row(0).array() += 1;
    return result;
  }

  // A binary .ply file with a property before the coordinates and bytes after the vertices.
  std::string write_ply(const std::string& name, const WeightMatrix& points) const {
    std::string content =
        "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(points.cols()) +
        "\nproperty uchar label\nproperty float x\nproperty float y\nproperty float z\n"
        "element camera 1\nproperty list uchar int numbers\nend_header\n";
    for (Index p = 0; p < points.cols(); ++p) {
      content += static_cast<char>(p % 7);
      for (int d = 0; d < 3; ++d) {
        const auto number = static_cast<float>(points(d, p));
        content.append(reinterpret_cast<const char*>(&number), sizeof number);
      }
    }
    content += std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13);
    return file(name, content);
  }

  std::string deform(const std::string& input, const std::string& output) const {
    return "deform " + input + rig_ + "-o " + output + ' ';
  }

  PointList<3> points_;
  std::string rig_;
};

TEST_F(DeformPoints, MovesArrays) {
  expect(deform("p.npy", "q.npy"), 0, "300 vertices, 1 pose");
  EXPECT_LT((io::read_weights("q.npy").dense() - moved(points_)).cwiseAbs().maxCoeff(), 1e-14);
}

// Weights of the points themselves need no mesh.
TEST_F(DeformPoints, MovesPointsByTheirOwnWeights) {
  const PointList<3> few = points_.leftCols(50);
  for (const std::string extension : {"npy", "csv"}) {
    const auto points = "few." + extension, moved_points = "moved." + extension;
    io::write_weights(points, few);
    expect("run " + tetrahedron() + ' ' + points + " --vertices 50 --pose pose.obj --force -o out");
    EXPECT_LT(
        (io::read_weights("out/deformed." + extension).dense() - moved(few)).cwiseAbs().maxCoeff(),
        1e-6);
    const std::string deform = "deform " + points + " --weights out/weights.npy --pose pose.obj ";
    expect(deform + "--rest " + tetrahedron() + " -o " + moved_points);
    EXPECT_LT((io::read_weights(moved_points).dense() - moved(few)).cwiseAbs().maxCoeff(), 1e-6);
    expect(deform + "-o " + moved_points);
    io::write_weights("others.npy", PointList<3>(0.9 * few));
    expect("deform others.npy --weights out/weights.npy --pose pose.obj -o q.npy --rest " +
               tetrahedron(),
           2, "others.npy");
  }
}

TEST_F(DeformPoints, KeepsAllOtherBytesOfPly) {
  write_ply("p.ply", points_);
  expect(deform("p.ply", "q.ply"));
  const auto expected =
      slurp(write_ply("expected.ply", moved(points_.cast<float>().cast<double>())));
  const auto found = slurp("q.ply");
  ASSERT_EQ(found.size(), expected.size());
  const auto vertices = expected.find("end_header\n") + 11;
  EXPECT_EQ(found.substr(0, vertices), expected.substr(0, vertices));
  EXPECT_EQ(found.substr(vertices + 13 * kPoints), expected.substr(vertices + 13 * kPoints));
  for (Index p = 0; p < kPoints; ++p) {
    const auto record = vertices + 13 * p;
    ASSERT_EQ(found[record], expected[record]);
    float of[6];
    std::memcpy(of, found.data() + record + 1, 12);
    std::memcpy(of + 3, expected.data() + record + 1, 12);
    for (int d = 0; d < 3; ++d) ASSERT_NEAR(of[d], of[d + 3], 1e-6);
  }
}

TEST_F(DeformPoints, FailuresLeaveNoFile) {
  points_.col(299).setConstant(2);
  io::write_weights("out.npy", points_);
  expect(deform("out.npy", "q.npy"), 2, "vertex 299 at (2, 2, 2)");
  auto content = slurp("p.npy");
  const double infinite = INFINITY;
  std::memcpy(content.data() + content.size() - 8, &infinite, 8);
  file("bad.npy", content);
  expect(deform("bad.npy", "q.npy"), 2, "number 899 is inf, which is not finite");
  file("short.npy", content.substr(0, content.size() - 1));
  expect(deform("short.npy", "q.npy"), 2, "bytes of numbers");
  expect(deform("p.npy", "p.npy"), 1);
  expect(deform("p.npy", "q.ply"), 1, ".npy");
  expect("deform p.npy --weights w.npy --pose pose.obj -o q.npy", 2, "300");
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path("."))) {
    const auto name = entry.path().filename().string();
    EXPECT_TRUE(name[0] != 'q' && name[0] != '.') << name;
  }
  expect(deform("out.npy", "q.npy") + "--outside keep", 0, "are not checked");
  expect(deform("out.npy", "q.npy") + "--outside nearest");
  EXPECT_NEAR(io::read_weights("q.npy").dense()(2, 299), 2 + 4.0 / 3 - 1.0 / 3, 1e-12);
}

}  // namespace
}  // namespace flbc::testing
