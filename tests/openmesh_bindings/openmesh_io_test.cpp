// SPDX-License-Identifier: BSD-3-Clause
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <fstream>

#include "flbc/openmesh/mesh_io.h"
#include "support/openmesh_model.h"
#include "support/scratch.h"

namespace flbc::openmesh {
namespace {

// With thirds as coordinates.
testing::OpenMeshModel open_box() {
  auto mesh = testing::box_with_attributes();
  for (const auto vertex : mesh.vertices()) mesh.point(vertex) /= 3;
  return mesh;
}

TEST(OpenMeshIo, KeepsPolygonsAndTheirOrder) {
  const auto mesh = open_box();
  for (const std::string extension : {"ply", "om", "obj", "off"}) {
    SCOPED_TRACE(extension);
    const auto path = testing::scratch_path("box." + extension);
    ASSERT_TRUE(OpenMesh::IO::write_mesh(mesh, path));
    const auto soup = read_polygons(path);
    ASSERT_EQ(soup.points.size(), 9U);
    ASSERT_EQ(soup.polygons.size(), 6U);
    for (std::size_t f = 0; f < 6; ++f) EXPECT_EQ(soup.polygons[f].size(), f < 5 ? 4U : 3U);
    for (const auto vertex : mesh.vertices()) {
      const auto& point = mesh.point(vertex);
      for (int d = 0; d < 3; ++d) EXPECT_NEAR(soup.points[vertex.idx()][d], point[d], 1e-5);
    }
  }
}

TEST(OpenMeshIo, KeepsDoublePointsOfOmFiles) {
  const auto path = testing::scratch_path("exact.om");
  ASSERT_TRUE(OpenMesh::IO::write_mesh(open_box(), path));
  EXPECT_EQ(read_polygons(path).points[1].x(), 0.25 / 3);
}

TEST(OpenMeshIo, MergesTheCornersOfStlFiles) {
  auto mesh = open_box();
  mesh.triangulate();
  const auto path = testing::scratch_path("box.stl");
  ASSERT_TRUE(OpenMesh::IO::write_mesh(mesh, path));
  const auto soup = read_polygons(path);
  EXPECT_EQ(soup.points.size(), 9U);
  EXPECT_EQ(soup.polygons.size(), 11U);
}

// Three triangles at one edge: no half-edge mesh could hold them, the soup must.
TEST(OpenMeshIo, KeepsNonManifoldFacesAndPrintsNothing) {
  const auto path = testing::scratch_path("fan.ply");
  std::ofstream(path) << "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\n"
                         "property float y\nproperty float z\nelement face 3\n"
                         "property list uchar int vertex_indices\nend_header\n"
                         "0 0 0\n0 0 1\n1 0 0\n0 1 0\n-1 0 0\n3 0 1 2\n3 0 1 3\n3 0 1 4\n";
  ::testing::internal::CaptureStderr();
  const auto soup = read_polygons(path);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(soup.polygons.size(), 3U);
}

// Whatever is cut off or changed, reading ends, with polygons or an InputError.
TEST(OpenMeshIo, SurvivesDamagedPlyFiles) {
  const auto path = testing::scratch_path("damaged.ply");
  using OpenMesh::IO::Options;
  for (const int flags : {0, int(Options::Binary), Options::Binary | Options::MSB}) {
    ASSERT_TRUE(OpenMesh::IO::write_mesh(open_box(), path, Options(flags)));
    EXPECT_EQ(read_polygons(path).polygons.size(), 6U);
    std::ifstream file(path, std::ios::binary);
    const std::string sound{std::istreambuf_iterator<char>(file), {}};
    const auto survives = [&](const std::string& content) {
      std::ofstream(path, std::ios::binary) << content;
      try {
        for (const auto& polygon : read_polygons(path).polygons) {
          for (const Index corner : polygon) ASSERT_LT(corner, 9);
        }
      } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).find(path), 0U) << error.what();
      }
    };
    for (std::size_t k = 0; k < sound.size(); ++k) {
      survives(sound.substr(0, k));
      for (const char c : {'9', '-', '\n', '\xff'}) {
        std::string changed = sound;
        changed[k] = c;
        survives(changed);
      }
    }
  }
}

TEST(OpenMeshIo, RefusesWhatItCannotRead) {
  EXPECT_THROW(read_polygons(testing::scratch_path("missing.ply")), IoError);
  const auto path = testing::scratch_path("garbage.ply");
  std::ofstream(path) << "this is no mesh\n";
  ::testing::internal::CaptureStderr();
  EXPECT_THROW(read_polygons(path), InputError);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace flbc::openmesh
