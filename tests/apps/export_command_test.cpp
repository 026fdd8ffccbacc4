// SPDX-License-Identifier: BSD-3-Clause
// flbc export as its users and their scripts see it.
#include "flbc/io/mesh_io.h"
#include "support/command_line.h"
#include "support/glb_file.h"
#include "support/model_cages.h"

namespace flbc::testing {
namespace {

double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).colwise().norm().maxCoeff();
}

class ExportCommand : public CommandLineTest {
 protected:
  Ended expect_export(const std::string& arguments, int status, const std::string& words) const {
    return expect("export " + arguments, status, words);
  }
  GlbFile skin(const std::string& name) const { return GlbFile(slurp(name)); }

  // A square with a texture, and all that belongs to it but the output.
  std::string square() const {
    const auto model =
        file("square.obj",
             "v 0.125 0.125 0.25\nv 0.25 0.125 0.25\nv 0.25 0.25 0.25\nv 0.125 0.25 0.25\n"
             "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
    return model + " --weights " + linear_weights(points_in<3>(model)) + " --cage " + tetrahedron();
  }

  // A sample, moved by its pose: the skin does what flbc deform does with as few influences.
  void expect_sample(const std::string& name, const std::string& domain_file) const {
    SCOPED_TRACE(name);
    const auto cage = name + "_cage.obj", pose = name + "_cage_pose.obj";
    const auto model = name + "_model.obj";
    expect("solve " + cage + " --method harmonic -q --vertices 1500 --save-domain " + domain_file +
           " --model " + model + " -o w.npy");
    expect("sparsify w.npy --cage " + cage + " --points " + model + " -k 4 -q -o w4.mtx --pose " +
           cage + " --pose " + pose);
    expect("deform " + model + " --weights w4.mtx --pose " + pose + " -q -o posed.obj");
    const auto result = expect_export(model + " --weights w.npy --cage " + cage +
                                          " -k 4 -o s.glb --pose " + cage + " " + pose + " --fps 4",
                                      0, "at most 4 influences per vertex (before ");
    expect_piece(result.errors, "2 poses in 0.25 s");
    const auto file = skin("s.glb");
    const double size = bounding_box_diagonal<3>(points_in<3>(model));
    EXPECT_LT(distance(file.skinned(file.joints()), points_in<3>(model)), 1e-6 * size);
    EXPECT_LT(distance(file.skinned(file.joints(0)), points_in<3>(model)), 1e-6 * size);
    EXPECT_LT(distance(file.skinned(file.joints(0.25)), points_in<3>("posed.obj")), 1e-6 * size);
    EXPECT_GT(distance(points_in<3>(model), points_in<3>("posed.obj")), 0.1 * size);
  }
};

TEST_F(ExportCommand, Sample2D) {
  expect_sample("2d/figure", "d.obj");
}
TEST_F(ExportCommand, Sample3D) {
  expect_sample("3d/limb", "d.mesh");
}

TEST_F(ExportCommand, InfoTellsWhatIsInASkin) {
  solve("3d/limb", "d.mesh");
  expect(
      "export 3d/limb_model.obj --weights w.npy --cage 3d/limb_cage.obj --pose "
      "3d/limb_cage_pose.obj --fps 1 -k 8 -q -o s.glb");
  const GlbFile skin(slurp("s.glb"));
  const auto info = expect("info s.glb").output;
  const auto contains = [&](const std::string& words) { expect_piece(info, words); };
  contains("glTF model of 3352 vertices, ");
  contains("animation of 1 s");
  contains("skin of " + std::to_string(skin.json["skins"][0]["joints"].size()) +
           " joints, at most 8 influences");
  // Nodes move meshes that have no skin.
  file("moved.gltf", R"({"nodes": [{"children": [1], "translation": [10, 0, 0]},
                                   {"mesh": 0, "scale": [1, 2, 1], "rotation": [0, 0, 1, 0]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"count": 3, "bufferView": 0, "componentType": 5120, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 9}],
    "buffers": [{"byteLength": 9, "uri": "data:;base64,AAAAAQABAQEA"}]})");
  const auto moved = expect("info moved.gltf").output;
  expect_piece(moved, "from (9, -2, 0) to (10, 0, 1)");
  for (const std::string& damaged : {slurp("s.glb").substr(0, 500), std::string("glTF"),
                                     std::string(R"({"meshes": 3})"), std::string()}) {
    expect("info " + file("u.glb", damaged), 2, "not a glTF file, or damaged");
  }
}

TEST_F(ExportCommand, BoundaryOfADomain) {
  for (const std::string name : {"d.mesh", "d.node", "d.vtu", "d.msh"}) {
    SCOPED_TRACE(name);
    const auto domain = name;
    expect("mesh 3d/torus_cage.obj --vertices 600 -o " + domain);
    expect("solve 3d/torus_cage.obj --method harmonic -q --domain " + domain + " -o w.npy");
    expect_export(domain + " --weights w.npy --cage 3d/torus_cage.obj -o s.glb", 0,
                  "at most 3 influences per vertex;");
    const auto file = skin("s.glb");
    const auto mesh = io::read_domain<3>(domain);
    const auto sources = file.sources();
    EXPECT_LT(sources.size(), mesh.num_vertices());
    EXPECT_LT(distance(file.skinned(file.joints()), mesh.points(Eigen::all, sources)), 1e-5);
  }
}

TEST_F(ExportCommand, QuadranglesWithATexture) {
  const auto arguments = square();
  expect_export(arguments + " -o s.glb", 0,
                "s.glb: 4 vertices, 2 triangles, 4 joints, at most 4 influences per vertex; ");
  const auto file = skin("s.glb");
  EXPECT_EQ(file.json["meshes"][0]["name"], "square");
  EXPECT_EQ(file.attribute("TEXCOORD_0"),
            (Eigen::MatrixXd(2, 4) << 0, 1, 1, 0, 1, 1, 0, 0).finished());
  EXPECT_EQ(file.attribute("NORMAL"), Eigen::Vector3d(0, 0, 1).replicate(1, 4));
  EXPECT_FALSE(file.has("JOINTS_1"));
  EXPECT_EQ(expect_export(arguments + " -q -o s.glb", 0, "").errors, "");
}

// A picture by its first bytes alone: nobody decodes it here.
constexpr char kPicture[] = "\x89PNG\r\n\x1a\nand so on";

TEST_F(ExportCommand, MaterialsAndPicturesOfObj) {
  file("look.mtl",
       "newmtl red one\nKd 1 0.25 0\nd 0.5\nNs 250\n\nnewmtl photo\nKd 0.1 0.1 0.1\n"
       "map_Kd -s 1 1 1 a photo.png\nnewmtl unused\nKd 0 0 1\n");
  std::ofstream("a photo.png", std::ios::binary) << kPicture;
  const auto model =
      file("m.obj",
           "mtllib look.mtl\nv 0.1 0.1 0.1\nv 0.2 0.1 0.1\nv 0.2 0.2 0.1\nv 0.1 0.2 0.1\n"
           "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nusemtl photo\nf 1/1 3/3 4/4\n"
           "usemtl red one\nf 4/4 3/3 2/2\nusemtl photo\nf 2/2 3/3 1/1\n");
  const auto rest = " --weights " + linear_weights(points_in<3>(model)) + " --cage " +
                    tetrahedron() + " -o s.glb";
  expect_no_piece(expect_export(model + rest, 0, "4 triangles").errors, "does not contain all");
  const auto skinned = skin("s.glb");
  const auto& json = skinned.json;
  const auto& primitives = json["meshes"][0]["primitives"];
  ASSERT_EQ(json["materials"].size(), 3U);
  std::map<std::string, std::size_t> corners;
  for (const auto& primitive : primitives) {
    EXPECT_EQ(primitive["attributes"], primitives[0]["attributes"]);
    const std::string name = json["materials"][primitive["material"].get<std::size_t>()]["name"];
    corners[name] = json["accessors"][primitive["indices"].get<std::size_t>()]["count"];
  }
  EXPECT_EQ(corners,
            (std::map<std::string, std::size_t>{{"model", 3}, {"photo", 6}, {"red one", 3}}));
  for (const auto& material : json["materials"]) {
    const auto& look = material["pbrMetallicRoughness"];
    if (material["name"] == "red one") {
      EXPECT_EQ(look["baseColorFactor"], (std::vector<double>{1, 0.25, 0, 0.5}));
      EXPECT_EQ(material["alphaMode"], "BLEND");
      EXPECT_NEAR(look["roughnessFactor"], 0.5, 1e-12);
    } else if (material["name"] == "photo") {
      EXPECT_EQ(look["baseColorTexture"]["index"], 0);
    }
  }
  ASSERT_EQ(json["images"].size(), 1U);
  EXPECT_EQ(json["images"][0]["mimeType"], "image/png");
  expect_piece(slurp("s.glb"), std::string(kPicture));

  std::filesystem::remove("a photo.png");
  expect_export(model + rest, 0, "does not contain all of");
  file("a photo.png", "no picture");
  expect_export(model + rest, 0, "glTF has .png and .jpg only");
  std::filesystem::remove("look.mtl");
  expect_export(model + rest, 0, "look.mtl cannot be read");
}

TEST_F(ExportCommand, PictureOfPly) {
  std::ofstream("t.jpg", std::ios::binary) << "\xff\xd8\xff and so on";
  const auto model =
      file("m.ply",
           "ply\nformat ascii 1.0\ncomment TextureFile t.jpg\nelement vertex 3\n"
           "property float x\nproperty float y\nproperty float z\nproperty float s\n"
           "property float t\nelement face 1\nproperty list uchar int vertex_indices\n"
           "end_header\n0.125 0.125 0.125 0 0\n0.25 0.125 0.125 1 0\n0.25 0.25 0.125 1 1\n"
           "3 0 1 2\n");
  expect_export(model + " --weights " + linear_weights(points_in<3>(model)) + " --cage " +
                    tetrahedron() + " -o s.glb",
                0, "1 triangles");
  const auto skinned = skin("s.glb");
  EXPECT_EQ(skinned.json["images"][0]["mimeType"], "image/jpeg");
  EXPECT_EQ(skinned.json["materials"].size(), 1U);
}

TEST_F(ExportCommand, TheCagesWireIsInASceneThatIsNotShown) {
  expect_export(square() + " -o s.glb", 0, "");
  const auto skinned = skin("s.glb");
  const auto& json = skinned.json;
  EXPECT_EQ(json["scene"], 0);
  const auto& wire = json["meshes"][1];
  EXPECT_EQ(wire["name"], "cage_wire");
  const auto& lines = wire["primitives"][0];
  EXPECT_EQ(lines["mode"], 1);
  EXPECT_EQ(json["accessors"][lines["indices"].get<std::size_t>()]["count"], 12);  // 6 edges
  const auto points = skinned.accessor(lines["attributes"]["POSITION"].get<std::size_t>());
  EXPECT_EQ(points, points_in<3>("cage.obj"));
  std::size_t node = 0;
  while (json["nodes"][node].value("mesh", 0) != 1) ++node;
  EXPECT_EQ(json["nodes"][node]["skin"], 0);
  const auto has_node = [&](std::size_t scene) {
    const std::set<std::size_t> nodes = json["scenes"][scene]["nodes"];
    return nodes.count(node) > 0;
  };
  EXPECT_FALSE(has_node(0));
  EXPECT_TRUE(has_node(1));
}

// What is painted on a model comes along from every format that has it.
TEST_F(ExportCommand, AttributesOfOtherFormats) {
  const auto model = file("m.obj",
                          "v 0.25 0.25 0.125 1 0 0.2\nv 0.5 0.25 0.125 0 0.4 0\n"
                          "v 0.25 0.5 0.125 0 0.6 1\nvt 0.25 0.5\nvt 1 0\nvt 0.5 1\n"
                          "vn 0 0.6 0.8\nvn 0 0 1\nvn 0.8 0 0.6\nf 1/1/1 2/2/2 3/3/3\n");
  const auto rest = " --weights " + linear_weights(points_in<3>(model)) + " --cage " +
                    tetrahedron() + " -q -o s.glb";
  expect_export(model + rest, 0, "");
  const auto expected = skin("s.glb");
  EXPECT_LT((expected.attribute("NORMAL").col(0) - Vector<3>(0, 0.6, 0.8)).norm(), 1e-6);
  for (const std::string name : {"m.ply", "m.off", "m.om"}) {
    SCOPED_TRACE(name);
    expect("convert " + model + " -q -o " + name);
    expect_export(name + rest, 0, "");
    const auto found = skin("s.glb");
    for (const char* attribute : {"POSITION", "NORMAL", "TEXCOORD_0", "COLOR_0"}) {
      ASSERT_TRUE(found.has(attribute)) << attribute;
      EXPECT_LT(distance(found.attribute(attribute), expected.attribute(attribute)), 1e-6);
    }
  }
}

TEST_F(ExportCommand, RoundedWeights) {
  const auto arguments = square() + " -o s.glb --quantize ";
  expect_export(arguments + "16", 0, "deformation error over random smooth poses ");
  EXPECT_EQ(skin("s.glb").influences("WEIGHTS_", true).colwise().sum(),
            Eigen::RowVectorXd::Constant(4, 65535));
  expect_export(arguments + "12", 1, "--quantize: invalid value '12'; choose from 8|16");
}

TEST_F(ExportCommand, KeyframesHaveTimes) {
  const std::string moved = "c 1 2 0 0\nc 1 0 0 0\nc 1 0 0 0\nc 1 0 0 0\n";
  const auto keys = file("keys.txt", "k 0.25\nk 1.5\n" + kRestKeys + moved);
  const auto command = square() + " -o s.glb --keyframes ";
  expect_export(command + keys, 0, "2 poses in 1.5 s that move 1 joints");
  const auto file_with_keys = skin("s.glb");
  const auto expect_first_joint = [&](double time, double x) {
    EXPECT_EQ(file_with_keys.joints(time)(0, 0), x);
  };
  expect_first_joint(0, 0);
  expect_first_joint(0.25, 0);
  expect_first_joint(0.875, 1);
  expect_first_joint(1.5, 2);

  std::filesystem::remove("s.glb");
  expect_export(command + file("k1.txt", "k 1\nk 1\n" + kRestKeys + moved), 2,
                "k1.txt: pose 1 is at 1 s, not later");
  expect_export(command + file("k2.txt", "k -1\n" + kRestKeys), 2, "k2.txt: pose 0 is at -1 s");
  expect_export(command + file("k3.txt", "k 0\nc 0 0 0 0\n"), 2, "for 1 control points");
  expect_export(command + keys + " --fps 3", 1, "--pose");
  expect_export(command + keys + " --pose cage.obj", 1, "cannot be combined with");
  EXPECT_FALSE(std::filesystem::exists("s.glb"));
}

TEST_F(ExportCommand, SequencesOfCages) {
  const auto command = square() + " -o s.glb";
  for (int k = 1; k <= 3; ++k) {
    const auto x = std::to_string(k - 1);
    tetrahedron("v " + x + " 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n",
                "pose_" + std::to_string(k) + ".obj");
  }
  expect_export(command + " --pose pose_%d.obj", 0, "3 poses in 0.0833333 s that move 1 joints");
  expect_export(command + " --pose pose_%d.obj --fps 0.5", 0, "3 poses in 4 s");
  EXPECT_EQ(skin("s.glb").joints(3)(0, 0), 1.5);
  expect_export(command + " --pose cage.obj", 0, "2 poses in 1 s that move 0 joints");
  EXPECT_FALSE(skin("s.glb").json.contains("animations"));
  // A single pose begins at rest.
  expect_export(command + " --pose pose_3.obj", 0, "2 poses in 1 s that move 1 joints");
  EXPECT_EQ(skin("s.glb").joints(0)(0, 0), 0);
  EXPECT_EQ(skin("s.glb").joints(0.5)(0, 0), 1);
  EXPECT_EQ(skin("s.glb").joints(1)(0, 0), 2);

  std::filesystem::remove("s.glb");
  expect_export(command + " --pose pose_%d.obj --fps 0", 1, "--fps");
  expect_export(command + " --pose absent_%d.obj", 4, "absent_0.obj");
  expect_export(command + " --pose 3d/limb_cage.obj", 2,
                "limb_cage.obj: has 54 vertices, but cage.obj has 4");
  EXPECT_FALSE(std::filesystem::exists("s.glb"));
}

TEST_F(ExportCommand, FilesThatDoNotFitAndWrongUsage) {
  const auto arguments = square();
  const std::string model = "square.obj";
  const std::string weights = " --weights w.npy";
  const std::string cage = " --cage cage.obj";
  const std::string output = " -o s.glb";
  const auto refused = [&](const std::string& words, int status, const std::string& message) {
    expect_export(words, status, message);
    EXPECT_FALSE(std::filesystem::exists("s.glb"));
  };
  refused(model + weights + output, 1, "--cage is required");
  refused(arguments + output + " -k 5", 1, "4 or 8 influences");
  refused(arguments + " -o s.gltf", 1, "must end in .glb");
  refused(arguments + " -o absent/s.glb", 4, "absent");
  refused("m.fbx" + weights + cage + output, 1, "must end in .obj");
  refused("absent.obj" + weights + cage + output, 4, "absent.obj");
  refused(model + " --weights absent.npy" + cage + output, 4, "absent.npy");
  refused(model + weights + " --cage absent.obj" + output, 4, "absent.obj");
  refused(model + weights + " --cage 3d/limb_cage.obj" + output, 2,
          "w.npy: has weights for 4 control points, but 3d/limb_cage.obj has 54");
  refused("cage.obj" + weights + cage + output, 2,
          "w.npy: the weights do not belong to this model: with cage.obj they put vertex ");
  refused("3d/limb_model.obj" + weights + cage + output, 2,
          "w.npy: has weights of 4 points, but 3d/limb_model.obj has 3352");
  const auto bare = file("bare.obj", "v 0.25 0.25 0.25\nl 1 1\n");
  refused(bare + weights + cage + output, 2, "bare.obj: its");
  const auto torn = file("torn.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n");
  refused(torn + weights + cage + output, 2, "torn.obj:4: the index 7 is out of range");
  const auto outside = file("outside.obj", "v 0.5 0.5 0.25\nv 0 0 0\nv 0 1 0\nf 1 2 3\n");
  refused(outside + " --weights " + linear_weights(points_in<3>(outside)) + cage + output, 2,
          "outside.obj: point 0 at (0.5, 0.5, 0.25) lies outside");
  const auto plane = file("plane.obj", "v 0 0\nv 4 0\nv 0 4\nl 1 2 3 1\n");
  refused(model + weights + " --cage " + plane + output, 2, "has weights of 3 points");
  refused(file("m.mesh", "") + weights + " --cage " + plane + output, 1, "the cage is in 2D");

  // No result may replace what is read.
  std::filesystem::copy("w.npy", "w.glb");
  expect_export(arguments + " -o w.glb --keyframes w.glb", 1, "would replace this input file");
  EXPECT_EQ(slurp("w.glb"), slurp("w.npy"));
}

TEST_F(ExportCommand, ARealModelWithTextureAndNormals) {
  if (!has_model("3d/clothing.obj")) GTEST_SKIP() << "the real models are absent";
  const auto model = model_path("3d/clothing.obj");
  const auto cage = model_path("3d/clothing_cage.obj");
  expect("solve " + cage + " --method harmonic --vertices 1500 -q -o w.npy --model " + model);
  const auto arguments = model + " --weights w.npy --cage " + cage;
  expect_export(arguments + " -o s.glb", 0, " 9132 triangles, 18 joints");
  const auto file = skin("s.glb");
  ASSERT_TRUE(file.has("TEXCOORD_0"));
  const Eigen::MatrixXd lengths = file.attribute("NORMAL").colwise().norm();
  EXPECT_LT((lengths.array() - 1).abs().maxCoeff(), 1e-6);
  const auto points = points_in<3>(model);
  // Seams part vertices, and all of them are there.
  const auto sources = file.sources();
  EXPECT_GT(sources.size(), points.cols());
  EXPECT_EQ(std::set<Eigen::Index>(sources.begin(), sources.end()).size(), points.cols());
  EXPECT_LT(distance(file.skinned(file.joints()), points(Eigen::all, sources)),
            1e-6 * bounding_box_diagonal<3>(points));
}

}  // namespace
}  // namespace flbc::testing
