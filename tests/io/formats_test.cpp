// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/formats.h"

#include <gtest/gtest.h>

#include "flbc/errors.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/model_file.h"
#include "support/io_files.h"
#include "support/sample_meshes.h"

namespace flbc::testing {
namespace {

using io::Content;
using io::holds;

class Formats : public FolderTest {};

TEST_F(Formats, ExtensionsTellWhatFilesHold) {
  EXPECT_TRUE(holds("a.OBJ", {Content::kModel}));
  EXPECT_TRUE(holds("folder.npy/a.off", {Content::kMesh2D}));
  EXPECT_FALSE(holds("a.off", {Content::kMesh3D, Content::kWeights, Content::kFields}));
  EXPECT_TRUE(holds("a.vtu", {io::kMesh<3>}));
  EXPECT_TRUE(holds("a.vtu", {io::kMesh<2>}));
  EXPECT_FALSE(holds("a.stl", {Content::kColors}));
  for (const char* unknown : {"obj", "a.", "a.txt", "-", ""}) {
    EXPECT_FALSE(holds(unknown, {Content::kModel, Content::kWeights})) << unknown;
  }
  EXPECT_EQ(io::extensions_of({Content::kFields}), ".vtu or .mesh");
  EXPECT_EQ(io::extensions_of({Content::kWeights}), ".mtx, .dmat, .npy, .csv or .lbw");
}

// What the table says a mesh can be written to, it can be read from.
template <int Dim>
void expect_meshes_return(const std::string& path) {
  const auto mesh = samples<Dim>().front().mesh;
  for (const std::string extension : {"obj", "off", "ply", "stl", "om", "vtu", "mesh", "node",
                                      "ele", "msh", "mtx", "dmat", "npy", "csv"}) {
    SCOPED_TRACE(extension);
    const auto file = path + "." + extension;
    if (holds(file, {io::kMesh<Dim>})) {
      io::write_domain<Dim>(file, mesh);
      EXPECT_EQ(io::read_domain<Dim>(file).cells, mesh.cells);
      if (!holds(file, {Content::kFields})) {
        EXPECT_THROW(io::write_domain<Dim>(file, mesh, {{"x", mesh.points.row(0)}}), OptionError);
      }
    } else {
      EXPECT_THROW(io::write_domain<Dim>(file, mesh), OptionError);
      EXPECT_THROW(io::read_domain<Dim>(file), OptionError);
    }
    if (!holds(file, {Content::kModel})) {
      EXPECT_THROW(io::read_polygons(file), OptionError);
      EXPECT_THROW(io::write_model(file, {}), OptionError);
    }
  }
}
TEST_F(Formats, MeshesReturn2D) {
  expect_meshes_return<2>(path("plane"));
}
TEST_F(Formats, MeshesReturn3D) {
  expect_meshes_return<3>(path("space"));
}

}  // namespace
}  // namespace flbc::testing
