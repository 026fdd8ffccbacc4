// SPDX-License-Identifier: BSD-3-Clause
// Models in other formats than theirs, read by OpenMesh alone.
#include "flbc/io/model_file.h"

#include "flbc/io/cage_io.h"
#include "support/model_kinds.h"

namespace flbc::testing {
namespace {

using io::ModelFile;
using OpenMesh::IO::Options;

class ModelConversion : public ModelFileTest {
 protected:
  std::string save(const std::string& name, const io::Model& model) const {
    io::write_model(path(name), model);
    return path(name);
  }
};

TEST_F(ModelConversion, EveryFormatBecomesEveryOther) {
  const auto mesh = box_with_attributes();
  for (const ModelKind& kind : kModelKinds) {
    write_kind(mesh, kind);
    const auto model = ModelFile(path(kind.file)).moved<3>(turned(points_of(mesh)));
    for (const char* output : {"o.obj", "o.off", "o.ply"}) {
      SCOPED_TRACE(kind.file + std::string(" ") + output);
      const auto moved = read_by_openmesh(save(output, model), kind.attributes());
      EXPECT_EQ(points_of(moved), turned(points_of(mesh)));
      expect_same_faces(moved, mesh);
      expect_same_paint(moved, mesh, kind.attributes());
      for (const auto v : mesh.vertices()) {
        EXPECT_LT((moved.normal(v) - turned(mesh.normal(v))).norm(), 1e-5);
      }
      EXPECT_EQ(io::losses(ModelFile(path(output)).model(), "any.ply"), std::vector<std::string>());
    }
    io::write_model(path("o.stl"), model);
    const auto triangles = read_by_openmesh(path("o.stl"), Options());
    EXPECT_EQ(triangles.n_vertices(), mesh.n_vertices());
    EXPECT_EQ(triangles.n_faces(), 11U);
  }
}

TEST_F(ModelConversion, CoordinatesSurviveAllFormatsButStl) {
  const auto awkward = awkward_numbers();
  std::string text;
  for (const double number : awkward) {
    std::ostringstream line;
    line.precision(17);
    line << "v " << number << " 1 " << number << "\n";
    text += line.str();
  }
  text += "f 1 2 3\n";
  auto model = open("a.obj", text).model();
  for (const bool is_text : {true, false}) {
    model.is_text = is_text;
    for (const char* output : {"o.obj", "o.off", "o.ply"}) {
      SCOPED_TRACE(output);
      const ModelFile written(save(output, model));
      EXPECT_TRUE(
          bit_equal(io::to_points<3>(written.model().soup, ""), io::to_points<3>(model.soup, "")));
      EXPECT_TRUE(io::extension_of(output) != "ply" || written.model().is_text == is_text);
    }
  }
}

TEST_F(ModelConversion, WhatIsLostIsTold) {
  const auto losses = [&](const std::string& text, const std::string& output) {
    return io::losses(open("a.obj", text).model(), output);
  };
  using Phrases = std::vector<std::string>;
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  EXPECT_EQ(losses(square + "f 1 2 3 4\n", "o.ply"), Phrases());
  EXPECT_EQ(losses(square + "f 1 2 3 4\n", "o.stl"),
            (Phrases{"the order of the vertices", "polygons (they are cut into triangles)"}));
  EXPECT_EQ(
      losses("# a\nmtllib m\n" + square + "usemtl x\ng y\nf 1 2 3\nf 1 3 4\nl 1 3\n", "o.off"),
      (Phrases{"lines with \"mtllib\"", "lines with \"usemtl\"", "lines with \"g\"", "comments",
               "polylines"}));
  // A seam: vertex 1 has two texture coordinates. Where two are the same there is none.
  const std::string paint = square + "vt 0 0\nvt 1 0\nvt 0 0\nvn 0 0 1\n";
  EXPECT_EQ(losses(paint + "f 1/1/1 2/2/1 3/2/1\nf 1/2/1 3/2/1 4/2/1\n", "o.ply"),
            (Phrases{"texture coordinates (they differ between corners of a vertex)"}));
  EXPECT_EQ(losses(paint + "f 1/1/1 2/2/1 3/2/1\nf 1/3/1 3/2/1 4/2/1\n", "o.ply"), Phrases());
  EXPECT_EQ(losses(paint + "f 1/1/1 2/2/1 3/2/1\nf 1/2/1 3/2/1 4/2/1\n", "o.obj"), Phrases());
  EXPECT_EQ(losses(paint + "f 1/1/1 2/2/1 3/2/1\nf 1/1 3/2 4/2\n", "o.off"),
            (Phrases{"normals (they differ between corners of a vertex)"}));
  const std::string coloured = "v 0.1 0 0 0.5 0 1\nv 1 0 0 0 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n";
  EXPECT_EQ(losses(coloured, "o.ply"), (Phrases{"colors beyond 256 levels"}));
  EXPECT_EQ(losses(coloured, "o.obj"), Phrases());
  EXPECT_EQ(losses(coloured, "o.stl"), (Phrases{"the order of the vertices",
                                                "coordinates beyond single precision", "colors"}));
  const auto seen = open("a.off",
                         "COFF\n3 1 0\n0 0 0 255 0 0 128\n1 0 0 0 255 0 255\n"
                         "0 1 0 1 1 1 255\n3 0 1 2 255 0 0\n");
  EXPECT_EQ(io::losses(seen.model(), "o.ply"), (Phrases{"transparency", "colors of polygons"}));
  EXPECT_EQ(seen.model().attributes.colors.col(1), Vector<3>(0, 1, 0));
}

}  // namespace
}  // namespace flbc::testing
