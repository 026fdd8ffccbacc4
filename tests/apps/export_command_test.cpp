// SPDX-License-Identifier: BSD-3-Clause
// flbc export as its users and their scripts see it.
#include "support/command_line.h"
#include "support/glb_file.h"
#include "support/model_cages.h"
#include "support/new_glb.h"

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

  static std::string square() {
    return file("square.obj",
                "v 0.125 0.125 0.25\nv 0.25 0.125 0.25\nv 0.25 0.25 0.25\n"
                "v 0.125 0.25 0.25\nf 1 2 3 4\n");
  }
  // A model in the tetrahedron, and all that belongs to it.
  std::string rig(const std::string& model, const std::string& output = "s.glb") const {
    return model + " --weights " + linear_weights(points_in<3>(model)) + " --cage " +
           tetrahedron() + " -o " + output;
  }
};

TEST_F(ExportCommand, InfoTellsWhatIsInASkin) {
  solve("3d/limb", "d.mesh");
  expect(
      "export 3d/limb_model.obj --weights w.npy --cage 3d/limb_cage.obj --pose "
      "3d/limb_cage_pose.obj --fps 1 -k 8 -q -o s.glb");
  const GlbFile skin(slurp("s.glb"));
  const auto info = expect("info s.glb").output;
  expect_piece(info, "glTF model of 3352 vertices, ");
  expect_piece(info, "animation of 1 s");
  expect_piece(info, "skin of " + std::to_string(skin.json["skins"][0]["joints"].size()) +
                         " joints, at most 8 influences");
  // Nodes move meshes that have no skin.
  file("moved.gltf", R"({"nodes": [{"children": [1], "translation": [10, 0, 0]},
                                   {"mesh": 0, "scale": [1, 2, 1], "rotation": [0, 0, 1, 0]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"count": 3, "bufferView": 0, "componentType": 5120, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 9}],
    "buffers": [{"byteLength": 9, "uri": "data:;base64,AAAAAQABAQEA"}]})");
  expect_piece(expect("info moved.gltf").output, "from (9, -2, 0) to (10, 0, 1)");
  expect("info " + file("u.glb", slurp("s.glb").substr(0, 500)), 2,
         "the file is cut off: it has 500 of " + std::to_string(slurp("s.glb").size()) + " bytes");
  for (const std::string damaged : {"glTF", ""}) {
    expect("info " + file("u.glb", damaged), 2,
           "not a glTF file, or damaged; export the model again");
  }
  expect("info " + file("u.glb", R"({"meshes": 3})"), 2, "no node of the scene uses one");
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
  const auto arguments = rig(model);
  expect_no_piece(expect_export(arguments, 0, "4 triangles").errors, "does not contain all");
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
  expect_export(arguments, 0, "does not contain all of");
  file("a photo.png", "no picture");
  expect_export(arguments, 0, "glTF has .png and .jpg only");
  std::filesystem::remove("look.mtl");
  expect_export(arguments, 0, "look.mtl cannot be read");
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
  expect_export(rig(model), 0, "1 triangles");
  const auto skinned = skin("s.glb");
  EXPECT_EQ(skinned.json["images"][0]["mimeType"], "image/jpeg");
  EXPECT_EQ(skinned.json["materials"].size(), 1U);
}

// The skin of the cage alone: its joints are the control points, so the model moves with them.
TEST_F(ExportCommand, JointsOfASkinnedCage) {
  const auto pose = tetrahedron("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.1 1.5\n", "pose.obj");
  expect_export(rig(tetrahedron(), "rig.glb") + " --pose " + pose, 0, "4 vertices");
  const auto arguments = rig(square()) + " --skeleton rig.glb";
  const auto errors = expect_export(arguments, 0, "6 joints, of which 1 move").errors;
  expect_piece(errors, "difference from the deformation by the cage over 2 keys");
  expect_piece(errors,
               "fits Unity, Unreal, Godot, three.js, Babylon.js, VRChat, Roblox, libGDX, Filament");
  expect_no_piece(errors, "morph targets");
  EXPECT_FALSE(skin("s.glb").primitive().contains("targets"));
  expect_piece(expect_export(arguments + " --correct", 0, "over 2 keys").errors,
               "with morph targets");
  EXPECT_EQ(skin("s.glb").primitive()["targets"].size(), 2U);
  expect_export(rig("s.glb", "t.glb") + " --skeleton rig.glb --correct", 2, "has morph targets");

  expect_export(rig(square()) + " --correct", 1, "--correct requires --skeleton");
  expect_export(arguments + " --pose " + pose, 1, "--pose cannot be combined with --skeleton");
  expect_export(rig(square(), "s.usda") + " --skeleton rig.glb", 1, ".glb only");
  expect_export(rig(square()) + " --skeleton " + pose, 2, "a skeleton is in a .glb");
  expect_export(rig(square(), "t.glb") + " --skeleton s.glb", 2, "no skinned mesh has all");
}

// Of a tetrahedron, each on an axis.
Eigen::MatrixXd corners() {
  return (Eigen::MatrixXd(3, 4) << 0, 1, 0, 0,  //
          0, 0, 1, 0,                           //
          0, 0, 0, 1)
      .finished();
}

// Two small tetrahedra in the cage, which show the same mesh, and a line.
NewGlb twins() {
  NewGlb file(R"({"scene":0,"scenes":[{"name":"stage","nodes":[0,2]}],
    "nodes":[{"name":"pair","children":[1],"mesh":0,"scale":[0.15,0.15,0.15],
              "translation":[0.4,0.1,0.1]},
             {"name":"twin","mesh":0,"translation":[0,1.1,0],"rotation":[0,0,0.6,0.8]},
             {"name":"eye","camera":0,"translation":[0,0,9]}],
    "cameras":[{"type":"perspective","perspective":{"yfov":0.7,"znear":0.01}}],
    "meshes":[{"name":"shape","primitives":[{"material":0},{"mode":1}]}],
    "materials":[{"name":"leaf","alphaMode":"MASK","alphaCutoff":0.25,
      "normalTexture":{"index":0,"texCoord":1},
      "pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0.5,1],"baseColorTexture":{"index":0}},
      "extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":0.125}}}],
    "textures":[{"source":0}],"extensionsUsed":["KHR_materials_clearcoat"],
    "animations":[{"channels":[{"sampler":0,"target":{"node":2,"path":"translation"}},
      {"sampler":0,"target":{"node":0,"path":"translation"}}],"samplers":[{"input":6,"output":7}]}]
    })");
  const auto faces = (Eigen::RowVectorXd(12) << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3).finished();
  auto& attributes = file.primitive(0)["attributes"];
  attributes["POSITION"] = file.add<float>(corners());
  attributes["NORMAL"] = file.add<float>(Eigen::MatrixXd(Vector<3>::UnitX().replicate(1, 4)));
  attributes["TANGENT"] =
      file.add<float>(Eigen::MatrixXd(Eigen::Vector4d(0, 1, 0, -1).replicate(1, 4)));
  attributes["TEXCOORD_0"] = file.add<float>(Eigen::MatrixXd::Random(2, 4));
  attributes["TEXCOORD_1"] = file.add<float>(Eigen::MatrixXd::Random(2, 4));
  file.primitive(0)["indices"] = file.add<std::uint16_t>(faces);
  file.primitive(0, 1)["attributes"]["POSITION"] = 0;
  file.add<float>(Eigen::RowVector2d(0, 1));
  file.json["accessors"][6]["min"] = {0};
  file.json["accessors"][6]["max"] = {1};
  file.add<float>(Eigen::MatrixXd::Random(3, 2));
  file.json["images"].push_back(
      {{"bufferView", file.add_view("\x89PNG\r\n\x1a\nodd")}, {"mimeType", "image/png"}});
  return file;
}

TEST_F(ExportCommand, DocumentsKeepWhatTheyHave) {
  const auto original = twins();
  const auto model = file("m.glb", original.glb());
  const auto points = points_in<3>(model);
  ASSERT_EQ(points.cols(), 8);
  const auto pose = tetrahedron("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.1 1.5\n", "pose.obj");
  const auto result = expect_export(rig(model) + " --pose " + pose, 0, "8 vertices");
  expect_piece(result.errors, "animations of nodes");
  const GlbChunks skin(slurp("s.glb"));
  // All bytes are there, and the JSON but for what a skin takes.
  EXPECT_EQ(skin.binary.substr(0, original.bytes.size()), original.bytes);
  for (const char* list : {"materials", "textures", "images", "cameras", "extensionsUsed"}) {
    EXPECT_EQ(skin.json[list], original.json[list]) << list;
  }
  EXPECT_EQ(skin.json["asset"], original.json["asset"]);
  for (std::size_t k = 0; k < original.json["nodes"].size(); ++k) {
    auto node = skin.json["nodes"][k], expected = original.json["nodes"][k];
    node.erase("skin");
    if (k == 1) node["mesh"] = 0;  // it has a copy
    for (const char* name : {"translation", "rotation", "scale", "children"}) {
      if (k < 2) expected.erase(name);  // skins are where their joints are
    }
    EXPECT_EQ(node, expected);
  }
  const auto roots = skin.json["scenes"][0]["nodes"].get<std::set<std::size_t>>();
  EXPECT_EQ(roots.count(0) + roots.count(1) + roots.count(2), 3U);
  EXPECT_EQ(skin.json["scenes"][0]["name"], "stage");
  EXPECT_EQ(skin.json["animations"][0]["channels"].size(), 1U);
  for (const std::size_t mesh : {0U, 1U}) {
    const auto& primitive = skin.json["meshes"][mesh]["primitives"][0];
    for (const auto& [name, accessor] :
         original.json["meshes"][0]["primitives"][0]["attributes"].items()) {
      EXPECT_EQ(primitive["attributes"][name], accessor) << name;
    }
    EXPECT_EQ(primitive["material"], 0);
  }
  // The cage moves both nodes as flbc deform moves the model.
  for (const int node : {0, 1}) {
    const GlbFile file(slurp("s.glb"), node);
    for (const double part : {0.0, 1.0}) {
      const Vector<3> move = part * Vector<3>(0.2, 0.1, 0.5);
      Eigen::MatrixXd joints = file.joints();
      joints.col(3) += move;
      const Eigen::MatrixXd expected = points + move * points.row(2);
      EXPECT_LT(distance(file.skinned(joints), expected.middleCols(4 * node, 4)), 1e-6);
    }
  }
}

// Nodes below others, with these.
std::set<std::size_t> reached(const NewGlb::Json& json, const NewGlb::Json& roots) {
  std::set<std::size_t> nodes;
  for (const std::size_t root : roots) {
    nodes.insert(root);
    if (json["nodes"][root].contains("children")) {
      nodes.merge(reached(json, json["nodes"][root]["children"]));
    }
  }
  return nodes;
}

TEST_F(ExportCommand, ScenesThatShowTheModelHaveItsCage) {
  auto original = twins();
  original.json["scenes"].push_back({{"nodes", {2}}});
  original.json["scenes"].push_back({{"nodes", {0}}});
  file("m0.glb", original.glb());
  // The second time the scenes of the first result are there as well.
  for (const auto& [model, result] : {std::pair("m0.glb", "m1.glb"), {"m1.glb", "m2.glb"}}) {
    expect_export(rig(model, result) + " -q", 0, "");
    const auto json = GlbChunks(slurp(result)).json;
    for (const auto& scene : json["scenes"]) {
      const auto nodes = reached(json, scene["nodes"]);
      for (const auto node : nodes) {
        if (!json["nodes"][node].contains("skin")) continue;
        const auto& skin = json["skins"][json["nodes"][node]["skin"].get<std::size_t>()];
        EXPECT_EQ(nodes.count(skin["skeleton"].get<std::size_t>()), 1U) << model;
      }
    }
    EXPECT_EQ(json["scenes"][1], original.json["scenes"][1]);  // without the model
  }
}

TEST_F(ExportCommand, PosesOfOldSkinsStay) {
  auto original = twins();
  original.json.erase("animations");
  original.json["scenes"][0]["nodes"] = {1, 2};
  original.json["nodes"][1] = {{"mesh", 0}, {"skin", 0}, {"weights", {0.5}}};
  original.json["nodes"][2] = {{"name", "bone"},
                               {"translation", {0.3, 0.2, 0.1}},
                               {"rotation", {0, 0, 0.6, 0.8}},
                               {"scale", {0.2, 0.2, 0.2}}};
  original.json["skins"] = {{{"joints", {2}}}};
  auto& primitive = original.primitive(0);
  primitive["targets"] = {
      {{"POSITION", original.add<float>(Eigen::MatrixXd::Constant(3, 4, 0.5))}}};
  primitive["attributes"]["JOINTS_0"] = original.add<std::uint8_t>(Eigen::MatrixXd::Zero(4, 4));
  primitive["attributes"]["WEIGHTS_0"] =
      original.add<float>(Eigen::MatrixXd(Eigen::Vector4d::UnitX().replicate(1, 4)));
  // Lines that share the numbers of the triangles, and lines that have some of their own.
  auto lines = primitive;
  lines["mode"] = 1;
  original.primitive(0, 1) = lines;
  lines["attributes"]["POSITION"] = original.add<float>(corners());
  original.json["meshes"][0]["primitives"].push_back(lines);
  const auto model = file("m.glb", original.glb());
  const auto points = points_in<3>(model);
  expect_piece(expect_export(rig(model), 0, "4 vertices").errors, "its own skins");
  EXPECT_LT(distance(points_in<3>("s.glb"), points), 1e-6);
  const GlbChunks skin(slurp("s.glb"));
  EXPECT_EQ(skin.json["nodes"][2], original.json["nodes"][2]);
  EXPECT_EQ(skin.json["nodes"][1]["weights"], original.json["nodes"][1]["weights"]);
  // Lines of the mesh are posed as well, though the cage does not move them.
  for (const std::size_t line : {1U, 2U}) {
    const auto& primitives = skin.json["meshes"][1]["primitives"];
    const auto &attributes = primitives[line]["attributes"], &first = primitives[0]["attributes"];
    EXPECT_EQ(skin.floats(attributes["POSITION"], 3), skin.floats(first["POSITION"], 3));
    EXPECT_EQ(skin.accessor(attributes["JOINTS_0"]),
              std::string("\4\0\0\0\4\0\0\0\4\0\0\0\4\0\0\0", 16));
  }
  // The other node with this mesh is not in the scene and keeps it.
  EXPECT_EQ(skin.json["meshes"][0], original.json["meshes"][0]);
  const auto& attributes = skin.json["meshes"][1]["primitives"][0]["attributes"];
  const Eigen::Quaterniond turn(0.8, 0, 0, 0.6);
  const auto normals = skin.floats(attributes["NORMAL"], 3),
             tangents = skin.floats(attributes["TANGENT"], 4);
  for (int v = 0; v < 4; ++v) {
    EXPECT_LT((normals.col(v).cast<double>() - turn * Vector<3>::UnitX()).norm(), 1e-6);
    EXPECT_LT((tangents.col(v).head<3>().cast<double>() - turn * Vector<3>::UnitY()).norm(), 1e-6);
  }
}

// The volume of the cone from the center of a surface to its triangles.
double volume(const Eigen::MatrixXd& points, const Eigen::MatrixXd& triangles) {
  double sum = 0;
  const Vector<3> center = points.rowwise().mean();
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k) {
      edges.col(k) = points.col(static_cast<Eigen::Index>(triangles(k, t))) - center;
    }
    sum += edges.determinant() / 6;
  }
  return sum;
}

double volume_of(const std::string& path) {
  const auto soup = io::read_polygons(path);
  Eigen::MatrixXd triangles(3, soup.polygons.size());
  for (std::size_t t = 0; t < soup.polygons.size(); ++t) {
    for (int k = 0; k < 3; ++k) triangles(k, static_cast<Eigen::Index>(t)) = soup.polygons[t][k];
  }
  return volume(io::to_points<3>(soup, path), triangles);
}

// The transform of its node decides which side of a triangle viewers show, not that of its joints.
TEST_F(ExportCommand, MirrorImagesKeepTheirFront) {
  const std::vector<int> faces{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  using Case = std::tuple<std::string, int, std::vector<int>>;
  constexpr int kTriangles = 4, kStrip = 5, kFan = 6;
  for (const auto& [name, mode, indices] :
       {Case{"triangles", kTriangles, faces}, Case{"not indexed", kTriangles, {}},
        Case{"strip", kStrip, {0, 2, 1, 3, 0, 2}}, Case{"fan", kFan, {0, 2, 1, 3, 2}},
        Case{"kept", kTriangles, faces}, Case{"skinned", kTriangles, faces},
        Case{"skinned and kept", kTriangles, faces}}) {
    SCOPED_TRACE(name);
    NewGlb original(R"({"scene":0,"scenes":[{"nodes":[0]}],
      "nodes":[{"children":[1,2],"scale":[-0.2,0.2,0.2],"translation":[0.4,0.1,0.1]},{"mesh":0},{}],
      "meshes":[{"primitives":[{}]}]})");
    auto& primitive = original.primitive(0);
    const Eigen::MatrixXd points =
        indices.empty() ? Eigen::MatrixXd(corners()(Eigen::all, faces)) : corners();
    primitive["attributes"]["POSITION"] = original.add<float>(points);
    primitive["mode"] = mode;
    if (!indices.empty()) {
      primitive["indices"] = original.add<std::uint16_t>(
          Eigen::Map<const Eigen::RowVectorXi>(indices.data(), indices.size()));
    }
    if (name.find("skinned") != std::string::npos) {
      primitive["attributes"]["JOINTS_0"] = original.add<std::uint8_t>(Eigen::MatrixXd::Zero(4, 4));
      primitive["attributes"]["WEIGHTS_0"] =
          original.add<float>(Eigen::MatrixXd(Eigen::Vector4d::UnitX().replicate(1, 4)));
      original.json["skins"] = {{{"joints", {2}}}};
      original.json["nodes"][1]["skin"] = 0;
    }
    const bool is_kept = name.find("kept") != std::string::npos;
    if (is_kept)
      original.json["nodes"][1]["extensions"] = {{"VENDOR_light", NewGlb::Json::object()}};
    const auto model = file("m.glb", original.glb());
    const auto expected = volume_of(model);
    EXPECT_GT(expected, 0);
    expect_export(rig(model) + " -q", 0, "");
    const auto exported = skin("s.glb");
    const double front = is_kept ? -1 : 1;
    EXPECT_NEAR(front * volume(exported.skinned(exported.joints()), exported.triangles()), expected,
                1e-6);
    EXPECT_NEAR(volume_of("s.glb"), expected, 1e-6);
    EXPECT_EQ(exported.primitive().value("mode", kTriangles), kTriangles);
    const GlbChunks chunks(slurp("s.glb"));
    for (const auto& unused : chunks.unused()) EXPECT_TRUE(unused.empty());
  }
}

// What the file had not used before stays; of the rest nothing is unused.
TEST_F(ExportCommand, WhatOnlyTheOldSkinNeededGoes) {
  auto original = twins();
  auto& json = original.json;
  json["meshes"][0]["primitives"].erase(1);
  json["nodes"][0] = {{"name", "body"}, {"mesh", 0}, {"skin", 0}};
  json["nodes"][1] = {{"name", "lamp"}, {"mesh", 1}, {"camera", 0}, {"scale", {0.1, 0.1, 0.1}}};
  json["nodes"][2] = {{"name", "bone"}, {"scale", {0.2, 0.2, 0.2}}, {"children", {1}}};
  json["meshes"].push_back(json["meshes"][0]);
  auto& attributes = original.primitive(0)["attributes"];
  const auto distinct = [&](int rows, int columns) {
    static double next = 1000;
    Eigen::MatrixXd numbers(rows, columns);
    for (double& number : numbers.reshaped()) number = next += 0.125;
    return original.add<float>(numbers);
  };
  const auto unused = distinct(4, 4);
  attributes["JOINTS_0"] = original.add<std::uint8_t>(Eigen::MatrixXd::Zero(4, 4));
  attributes["WEIGHTS_0"] = distinct(4, 4);
  const auto binds =
      original.add<float>(Eigen::MatrixXd(Eigen::Matrix4d::Identity().reshaped(16, 1)));
  json["skins"] = {{{"joints", {2}}, {"inverseBindMatrices", binds}}};
  const auto moves = distinct(3, 2);
  json["animations"][0]["samplers"].push_back({{"input", 6}, {"output", moves}});
  json["animations"][0]["channels"][1] = {{"sampler", 1},
                                          {"target", {{"node", 2}, {"path", "translation"}}}};
  json["animations"][0]["channels"][0]["target"]["node"] = 3;
  json["nodes"].push_back({{"name", "sun"}, {"extras", {{"bufferView", 2}}}});
  json["scenes"][0]["nodes"].push_back(3);
  const GlbChunks before(original.glb());
  ASSERT_EQ(before.unused()[0], std::set<std::size_t>{unused});
  const auto model = file("m.glb", original.glb());
  const auto points = points_in<3>(model);
  expect_export(rig(model), 0, "8 vertices");
  EXPECT_LT(distance(points_in<3>("s.glb"), points), 1e-6);
  const GlbChunks after(slurp("s.glb"));
  const auto left = after.unused();
  ASSERT_EQ(left[0].size(), 1U);
  EXPECT_TRUE(left[1].empty());
  EXPECT_EQ(after.accessor(*left[0].begin()), before.accessor(unused));
  for (const auto number : {attributes["WEIGHTS_0"].get<std::size_t>(), moves}) {
    EXPECT_EQ(after.binary.find(before.accessor(number)), std::string::npos) << number;
  }
  // The rest has its bytes, under other numbers.
  const auto& old_attributes = before.json["meshes"][0]["primitives"][0]["attributes"];
  for (const std::size_t mesh : {0U, 1U}) {
    const auto& primitive = after.json["meshes"][mesh]["primitives"][0];
    for (const char* name : {"TEXCOORD_0", "TEXCOORD_1"}) {
      EXPECT_EQ(after.accessor(primitive["attributes"][name]),
                before.accessor(old_attributes[name]));
    }
    EXPECT_EQ(after.accessor(primitive["indices"]), before.accessor(5));
  }
  EXPECT_EQ(after.view(after.json["images"][0]["bufferView"]), "\x89PNG\r\n\x1a\nodd");
  const auto& animation = after.json["animations"][0];
  ASSERT_EQ(animation["samplers"].size(), 1U);
  EXPECT_EQ(after.accessor(animation["samplers"][0]["output"]), before.accessor(7));
  EXPECT_EQ(after.json["nodes"][3], before.json["nodes"][3]);
  // The camera needs its place.
  EXPECT_EQ(after.json["nodes"][1]["scale"], before.json["nodes"][1]["scale"]);
  EXPECT_EQ(after.json["nodes"][2], before.json["nodes"][2]);
}

TEST_F(ExportCommand, SequencesOfCages) {
  const auto command = rig(square());
  for (int k = 1; k <= 3; ++k) {
    const auto x = std::to_string(k - 1);
    tetrahedron("v " + x + " 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n",
                "pose_" + std::to_string(k) + ".obj");
  }
  expect_export(command + " --pose pose_%d.obj", 0, "of which 1 move within 0.0833 s");
  expect_export(command + " --pose pose_%d.obj --fps 0.5", 0, "move within 4 s");
  EXPECT_EQ(skin("s.glb").joints(3)(0, 0), 1.5);
  expect_export(command + " --pose cage.obj", 0, "of which 0 move within 1 s");
  EXPECT_FALSE(skin("s.glb").json.contains("animations"));
  // A single pose begins at rest.
  expect_export(command + " --pose pose_3.obj", 0, "of which 1 move within 1 s");
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
  const std::string model = square(), arguments = rig(model, ""), weights = " --weights w.npy",
                    cage = " --cage cage.obj", output = " -o s.glb";
  const auto refused = [&](const std::string& words, int status, const std::string& message) {
    expect_export(words, status, message);
    EXPECT_FALSE(std::filesystem::exists("s.glb"));
  };
  refused(model + weights + output, 1, "add --cage");
  refused(arguments + "s.glb -k 5", 1, "4 or 8 influences");
  refused(arguments + "s.gltf", 1, "must end in .glb");
  refused(arguments + "absent/s.glb", 4, "absent");
  refused(model + weights + " --cage absent.obj" + output, 4, "absent.obj");
  refused(model + weights + " --cage 3d/limb_cage.obj" + output, 2,
          "w.npy: has weights for 4 control points, but 3d/limb_cage.obj has 54");
  refused("cage.obj" + weights + cage + output, 2,
          "w.npy: the weights do not belong to this model: with cage.obj they put vertex ");
  refused("3d/limb_model.obj" + weights + cage + output, 2,
          "w.npy: has weights of 4 points, but 3d/limb_model.obj has 3352");
  const auto outside = file("outside.obj", "v 0.5 0.5 0.25\nv 0 0 0\nv 0 1 0\nf 1 2 3\n");
  refused(outside + " --weights " + linear_weights(points_in<3>(outside)) + cage + output, 2,
          "outside.obj: point 0 at (0.5, 0.5, 0.25) lies outside");
  const auto plane = file("plane.obj", "v 0 0\nv 4 0\nv 0 4\nl 1 2 3 1\n");
  refused(file("m.mesh", "") + weights + " --cage " + plane + output, 1, "the cage is in 2D");

  // No result may replace what is read.
  std::filesystem::copy("w.npy", "w.glb");
  expect_export(arguments + "w.glb --pose w.glb", 1, "would replace this input file");
  EXPECT_EQ(slurp("w.glb"), slurp("w.npy"));
}

}  // namespace
}  // namespace flbc::testing
