// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/model_file.h"

#include "flbc/io/cage_io.h"
#include "support/io_files.h"

namespace flbc::testing {
namespace {

class ObjAttributesTest : public FolderTest {
 protected:
  io::SurfaceAttributes read(const std::string& text) const {
    return io::ModelFile(make("model.obj", text)).model().attributes;
  }
  void expect_refusal(const std::string& text, const std::string& message) const {
    expect_error<InputError>([&] { read(text); }, {"model.obj:", message});
  }
};

const char* const kThreePoints = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST_F(ObjAttributesTest, CornersReferToTextureCoordinatesAndNormals) {
  // Lists may follow their use, numbers count from 1 or backwards, and any of them may be missing.
  const auto found = read(std::string(kThreePoints) +
                          "vt 0.25 0.5\n vt 0.75\n"
                          "f 1/1/2 2/2/2 3//1\n"  // the normals are still to come
                          "vn 0 0 2\n"
                          "f 1/-2 2 3/\n"
                          "vt 1 1 1 # with a third coordinate\nvn 1 0 0\n");
  ASSERT_EQ(found.texture_coordinates.cols(), 3);
  EXPECT_EQ(found.texture_coordinates.col(0), Vector<2>(0.25, 0.5));
  EXPECT_EQ(found.texture_coordinates.col(1), Vector<2>(0.75, 0));
  EXPECT_EQ(found.texture_coordinates.col(2), Vector<2>(1, 1));
  ASSERT_EQ(found.normals.cols(), 2);
  EXPECT_EQ(found.normals.col(0), Vector<3>(0, 0, 2));
  ASSERT_EQ(found.corners.size(), 2);
  const auto expect_corner = [&](int polygon, int corner, Index texture, Index normal) {
    SCOPED_TRACE(corner);
    EXPECT_EQ(found.corners[polygon][corner].texture_coordinate, texture);
    EXPECT_EQ(found.corners[polygon][corner].normal, normal);
  };
  expect_corner(0, 0, 0, 1);
  expect_corner(0, 2, -1, 0);
  expect_corner(1, 0, 0, -1);
  expect_corner(1, 1, -1, -1);
  expect_corner(1, 2, -1, -1);
}

TEST_F(ObjAttributesTest, ColoursOnlyIfAllVerticesHaveThem) {
  const auto coloured = read("v 0 0 0 1 0 0\nv 1 0 0 0 0.5 0\nv 0 1 0 0 0 1 0.5\n");
  ASSERT_EQ(coloured.colors.cols(), 3);
  EXPECT_EQ(coloured.colors.col(1), Vector<3>(0, 0.5, 0));
  EXPECT_EQ(coloured.colors.col(2), Vector<3>(0, 0, 1));
  EXPECT_EQ(read("v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 0 0 1\n").colors.cols(), 0);
  EXPECT_EQ(read("v 0 0 0 255 0 0\nv 1 0 0 0 0 0\nv 0 1 0 0 0 1\n").colors.cols(), 0);
  EXPECT_EQ(read("v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\n").colors.cols(), 0);
}

TEST_F(ObjAttributesTest, NothingIsThere) {
  const auto plain = read(std::string(kThreePoints) + "l 1 2\nf 1 2 3\n");
  EXPECT_EQ(plain.texture_coordinates.cols(), 0);
  EXPECT_EQ(plain.normals.cols(), 0);
  EXPECT_EQ(plain.colors.cols(), 0);
  ASSERT_EQ(plain.corners.size(), 1);
  EXPECT_EQ(plain.corners[0].size(), 3);
}

TEST_F(ObjAttributesTest, DamagedFiles) {
  const std::string triangle = kThreePoints;
  expect_refusal(triangle + "vt zero 0\n", "model.obj:4: expected a number");
  expect_refusal(triangle + "vn 0 1\n", "model.obj:4: expected a number");
  expect_refusal(triangle + "vn 0 0 1\\\nv 1 2 3\nf 1 2 3\n", "continued on another line");
  expect_error<IoError>([&] { io::ModelFile(path("absent.obj")); }, {"absent.obj"});
}

// Twice the area of a triangle along z.
double area(const std::vector<Vector<3>>& corners, const Eigen::Matrix<Index, 3, 1>& triangle) {
  const Vector<3> ab = corners[triangle[1]] - corners[triangle[0]];
  const Vector<3> ac = corners[triangle[2]] - corners[triangle[0]];
  return ab.x() * ac.y() - ab.y() * ac.x();
}

TEST(CutPolygon, CoversThePolygonOnce) {
  // A comb: no fan would do.
  const std::vector<Vector<3>> comb = {{0, 0, 0}, {5, 0, 0}, {5, 4, 0}, {4, 1, 0},
                                       {3, 4, 0}, {2, 1, 0}, {1, 4, 0}};
  const auto triangles = io::cut_polygon(comb);
  ASSERT_EQ(triangles.cols(), 5);
  double sum = 0;
  for (const auto& triangle : triangles.colwise()) {
    EXPECT_GT(area(comb, triangle), 0);
    sum += area(comb, triangle);
  }
  double twice_area = 0;  // by the shoelace formula
  for (std::size_t k = 0; k < comb.size(); ++k) {
    const auto& a = comb[k];
    const auto& b = comb[(k + 1) % comb.size()];
    twice_area += a.x() * b.y() - a.y() * b.x();
  }
  EXPECT_NEAR(sum, twice_area, 1e-12);
}

TEST(CutPolygon, QuadranglesAndTriangles) {
  const std::vector<Vector<3>> flat = {{0, 0, 1}, {3, 0, 1}, {3, 1, 1}, {0, 1, 1}};
  EXPECT_EQ(io::cut_polygon(flat).cols(), 2);
  // The shorter diagonal joins corners 1 and 3.
  const std::vector<Vector<3>> kite = {{0, 0, 0}, {2, -1, 0}, {9, 0, 0}, {2, 1, 0}};
  const auto cut = io::cut_polygon(kite);
  for (const auto& triangle : cut.colwise()) {
    EXPECT_TRUE((triangle.array() == 1).any());
    EXPECT_TRUE((triangle.array() == 3).any());
    EXPECT_GT(area(kite, triangle), 0);
  }
  EXPECT_EQ(io::cut_polygon({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
            (FacetList<3>(3, 1) << 0, 1, 2).finished());
}

}  // namespace
}  // namespace flbc::testing
