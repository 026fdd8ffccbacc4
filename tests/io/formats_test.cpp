// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/formats.h"

#include "flbc/io/model_file.h"
#include "support/io_files.h"

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
  EXPECT_EQ(io::extensions_of({Content::kFields}), ".vtu");
  EXPECT_EQ(io::extensions_of({Content::kWeights}), ".mtx, .npy or .csv");
}

TEST_F(Formats, OtherFilesAreNoModels) {
  for (const char* name : {"a.vtu", "a.mesh", "a.msh", "a.npy", "a.csv", "a"}) {
    EXPECT_THROW(io::read_polygons(path(name)), OptionError) << name;
    EXPECT_THROW(io::write_model(path(name), {}), OptionError) << name;
  }
}

}  // namespace
}  // namespace flbc::testing
