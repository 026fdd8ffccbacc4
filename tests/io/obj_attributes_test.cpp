// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/model_file.h"

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

TEST_F(ObjAttributesTest, DamagedFiles) {
  const std::string triangle = kThreePoints;
  expect_refusal(triangle + "vt zero 0\n", "model.obj:4: expected a number");
  expect_refusal(triangle + "vn 0 1\n", "model.obj:4: expected a number");
  expect_error<IoError>([&] { io::ModelFile(path("absent.obj")); }, {"absent.obj"});
}

}  // namespace
}  // namespace flbc::testing
