// SPDX-License-Identifier: BSD-3-Clause
// flbc convert as its users and their scripts see it.
#include "flbc/io/cage_io.h"
#include "flbc/io/mesh_io.h"
#include "support/command_line.h"
#include "support/io_files.h"
#include "support/new_glb.h"

namespace flbc::testing {
namespace {

class ConvertCommand : public CommandLineTest {
 protected:
  void expect_converted(const std::string& arguments, const std::string& words = "") const {
    expect("convert " + arguments, 0, words);
  }

  void expect_refused(const std::string& arguments, int status, const std::string& words) const {
    CommandLineTest::expect_refused("convert " + arguments, status, words);
  }

  WeightMatrix read(const std::string& name) const { return io::read_weights(name).dense(); }

  // Five points and three control points, without weights of the last of either.
  WeightMatrix write_weights(const std::string& name) const {
    WeightMatrix weights = WeightMatrix::Zero(3, 5);
    weights << 1 / 3.0, 1, -1e-17, 0, 0,  //
        2 / 3.0, 0, 1e-300, 0.1, 0,       //
        0, 0, 0, 0, 0;
    io::write_weights(name, weights);
    return weights;
  }
};

TEST_F(ConvertCommand, WeightsBetweenAllFormats) {
  const std::string formats[] = {"npy", "mtx", "csv"};
  const auto weights = write_weights("a.npy");
  for (const auto& from : formats) {
    if (from != "npy") expect_converted("a.npy -o a." + from);
    EXPECT_TRUE(bit_equal(read("a." + from), weights)) << from;
    for (const auto& to : formats) {
      const auto there = "b." + to, back = "c." + from;
      expect_converted("a." + from + " -o " + there,
                       "b." + to + ": weights of 5 points for 3 control points");
      EXPECT_TRUE(bit_equal(read("b." + to), weights)) << from << " " << to;
      expect_converted(there + " -q -o " + back);
      EXPECT_EQ(slurp(back), slurp("a." + from)) << from << " " << to;
    }
  }
  EXPECT_EQ(run("convert -q a.npy -o d.csv").errors, "");
}

TEST_F(ConvertCommand, Transpose) {
  const auto weights = write_weights("a.npy");
  io::write_weights("t.npy", weights.transpose());
  expect_converted("t.npy --transpose -o b.npy");
  EXPECT_TRUE(bit_equal(read("b.npy"), weights));
}

// A triangle that its joint has moved by 5, in a node that is moved by 2.
TEST_F(ConvertCommand, SkinnedModelsGoBackToTheirBindPose) {
  NewGlb skinned(R"({"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[
    {"mesh":0,"skin":0,"translation":[2,0,0],"name":"body"},{"translation":[5,0,0]}],
    "meshes":[{"primitives":[{}]}],"skins":[{"joints":[1]}],"materials":[{"name":"cloth"}]})");
  const Eigen::Matrix3d corners = Eigen::Matrix3d::Identity();
  const NewGlb::Json attributes = {
      {"POSITION", skinned.add<float>(corners)},
      {"JOINTS_0", skinned.add<std::uint8_t>(Eigen::MatrixXd::Zero(4, 3))},
      {"WEIGHTS_0", skinned.add<float>(Eigen::MatrixXd::Identity(4, 3))}};
  skinned.primitive(0) = {{"attributes", attributes}, {"material", 0}};
  skinned.json["images"] = {{{"uri", file("dot.png", "\x89PNG\r\n\x1a\n")}}, {{"uri", "gone.png"}}};
  const auto posed = file("posed.glb", skinned.glb());
  expect_converted(posed + " --bind-pose -o rest.glb",
                   "rest.glb does not contain all of posed.glb: a picture: posed.glb: cannot read");
  expect_converted(posed + " -o again.glb", "lost: a picture: posed.glb: cannot read \"gone.png\"");
  EXPECT_EQ(points_in<3>(posed), (corners.colwise() + Vector<3>(5, 0, 0)).eval());
  EXPECT_EQ(points_in<3>("rest.glb"), (corners.colwise() + Vector<3>(2, 0, 0)).eval());
  const auto json = GlbChunks(slurp("rest.glb")).json;
  EXPECT_FALSE(json.contains("skins"));
  EXPECT_EQ(json["materials"], skinned.json["materials"]);
  EXPECT_EQ(json["images"][0]["mimeType"], "image/png");
  EXPECT_EQ(json["meshes"][0]["primitives"][0]["attributes"].size(), 1);

  expect_refused("rest.glb --bind-pose -o b.glb", 2, "rest.glb: the file has no skin");
  expect_refused(posed + " --bind-pose -o b.obj", 1, "b.obj; convert the .glb file in a second");
  write_weights("a.npy");
  expect_refused("a.npy --bind-pose -o b.glb", 1, "not for a.npy");
}

TEST_F(ConvertCommand, WrongKindsAreRefusedByName) {
  write_weights("a.npy");
  file("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n");
  io::write_domain("a.mesh", samples<3>().front().mesh);
  for (const char* empty : {"a.obj.gz", "a.spz", "a.dxf", "a.vtu", "a.node", "a.dmat"}) {
    file(empty, "");
  }
  file("a.fbx", "Kaydara FBX Binary");
  using Row = std::tuple<std::string, int, std::string>;
  for (const auto& [arguments, status, words] :
       {Row{"a.npy -o b.obj", 1, "b.obj: weights cannot be written as a mesh"},
        Row{"a.obj -o b.npy", 1, "b.npy: a mesh cannot be written as weights"},
        Row{"a.txt -o b.npy", 1, "weights end in .mtx, .npy, .csv or .npz"},
        Row{"a.npy -o b.txt", 1, "must end in .mtx, .npy, .csv or .npz"},
        Row{"a.obj -o b.xls", 1, "b.xls: unknown file format"},
        Row{"a.obj -o b.msh", 1, "b.msh: a.obj holds no tetrahedra"},
        Row{"a.mesh -o b.obj", 1, "b.obj: a.mesh holds tetrahedra"},
        // Formats of other programs.
        Row{"a.fbx -o b.ply", 1, "convert it to .obj or .ply first, for example in Blender"},
        Row{"a.obj.gz -o b.ply", 1, "unpack it first"},
        Row{"a.spz -o b.ply", 1, "uncompressed .ply"},
        Row{"a.dxf -o b.ply", 1, "save the drawing as .svg first"},
        Row{"a.obj -o b.fbx", 1, "usually read glTF"},
        Row{"a.obj -o b.vtu", 2, "vertex 2 at (0, 1, 1) is not in the plane z = 0"},
        Row{"a.obj -o b.ply --transpose", 1, "a.obj is a mesh"},
        Row{"a.npy -o a.npy", 1, "would replace this input file"},
        Row{"a.npy -o absent/b.npy", 4, "absent"}, Row{"missing.npy -o b.npy", 4, "missing.npy"},
        Row{"missing.ply -o b.obj", 4, "missing.ply"},
        Row{"a.vtu -o b.mesh", 1, "a.vtu: .vtu files are only written"},
        Row{"a.node -o b.mesh", 1, "convert it to .mesh first"},
        Row{"a.dmat -o b.npy", 1, "write .csv from libigl"}}) {
    expect_refused(arguments, status, words);
  }
}

}  // namespace
}  // namespace flbc::testing
