// SPDX-License-Identifier: BSD-3-Clause
// What glTF documents say about shapes: skins, morph targets, mirrored nodes; what is not
// understood; and what stays when vertices move.
#include <cstdio>
#include <cstring>
#include <limits>
#include <random>
#include <sstream>

#include <Eigen/Geometry>

#include "flbc/io/cage_io.h"
#include "flbc/io/model_file.h"
#include "format_test.h"
#include "support/new_glb.h"

namespace flbc::testing {
namespace {

using io::ModelFile;
using Json = NewGlb::Json;
using Points = Eigen::MatrixXd;

// A tetrahedron, each corner on an axis.
Points corners() {
  return (Points(3, 4) << 0, 1, 0, 0,  //
          0, 0, 1, 0,                  //
          0, 0, 0, 1)
      .finished();
}
const Eigen::RowVectorXd kFaces =
    (Eigen::RowVectorXd(12) << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3).finished();

// A node with a tetrahedron.
NewGlb tetrahedron(const Points& points = corners()) {
  NewGlb file(R"({"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"body","mesh":0}],
    "meshes":[{"name":"shape","primitives":[{}]}]})");
  file.primitive(0)["attributes"]["POSITION"] = file.add<float>(points);
  file.primitive(0)["indices"] = file.add<std::uint16_t>(kFaces);
  return file;
}

double volume(const io::PolygonSoup& soup) {
  double sum = 0;
  for (const auto& face : soup.polygons) {
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = soup.points[face[k]];
    sum += edges.determinant() / 6;
  }
  return sum;
}

class GltfDocumentTest : public FormatTest {
 protected:
  ModelFile read(const NewGlb& file, const std::string& name = "a.glb") const {
    return ModelFile(make(name, file.glb()));
  }
  static PointList<3> points(const ModelFile& file) {
    return io::to_points<3>(file.model().soup, "");
  }
  PointList<3> points(const NewGlb& file) const { return points(read(file)); }
  // Where the result of moved() has its points.
  PointList<3> moved_points() const { return points(ModelFile(path("moved.glb"))); }
  GlbChunks moved(const ModelFile& file, const PointList<3>& points) const {
    std::ostringstream out;
    file.write<3>(out, points);
    make("moved.glb", out.str());
    return GlbChunks(out.str());
  }
  void refuse(const NewGlb& file, const std::string& message) const {
    make("bad.glb", file.glb());
    expect_error<InputError>([&] { ModelFile(path("bad.glb")); }, {"bad.glb", message});
  }
};

// ------------------------------------------------------------------------------------------- skins

// A tetrahedron whose last two corners have influences of two joints, which nodes have posed.
struct Skinned {
  Eigen::Affine3d nodes[2], binds[2];  // global; inverse of where the joints were bound
  Points weights{2, 4};
  NewGlb file = tetrahedron();

  explicit Skinned(bool is_reversed = false, bool has_two_sets = false) {
    weights << 1, 0, 0.25, 0.75,  //
        0, 1, 0.75, 0.25;
    nodes[0] = Eigen::Translation3d(0, 0, 1);
    nodes[1] = nodes[0] * Eigen::Translation3d(0.5, 0, 0) *
               Eigen::AngleAxisd(M_PI / 2, Vector<3>::UnitZ());
    binds[0] = Eigen::Affine3d::Identity();
    binds[1] = Eigen::Translation3d(-0.5, 0, 0);
    auto& json = file.json;
    // The node of the mesh does not count.
    json["nodes"][0]["translation"] = {100, 0, 0};
    json["nodes"][0]["skin"] = 0;
    json["nodes"].push_back({{"translation", {0, 0, 1}}, {"children", {2}}});
    json["nodes"].push_back(
        {{"translation", {0.5, 0, 0}}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}});
    json["scenes"][0]["nodes"].push_back(1);
    Points matrices(16, 2);
    for (int j = 0; j < 2; ++j)
      matrices.col(is_reversed ? 1 - j : j) = binds[j].matrix().reshaped();
    json["skins"].push_back({{"joints", is_reversed ? Json{2, 1} : Json{1, 2}},
                             {"inverseBindMatrices", file.add<float>(matrices)}});
    Points first = Points::Zero(4, 4), second = Points::Zero(4, 4);
    Points joints = Points::Zero(4, 4);
    const int slot = has_two_sets ? 0 : 1;
    first.row(0) = weights.row(0);
    (has_two_sets ? second : first).row(slot) = weights.row(1);
    joints.row(0).setConstant(is_reversed ? 1 : 0);
    Points others = Points::Zero(4, 4);
    (has_two_sets ? others : joints).row(slot).setConstant(is_reversed ? 0 : 1);
    auto& attributes = file.primitive(0)["attributes"];
    attributes["JOINTS_0"] = file.add<std::uint8_t>(joints);
    attributes["WEIGHTS_0"] = file.add<float>(first);
    if (!has_two_sets) return;
    attributes["JOINTS_1"] = file.add<std::uint8_t>(others);
    attributes["WEIGHTS_1"] = file.add<float>(second);
  }

  Points posed() const {
    Points result = Points::Zero(3, 4);
    for (int v = 0; v < 4; ++v) {
      for (int j = 0; j < 2; ++j) {
        result.col(v) += weights(j, v) * (nodes[j] * binds[j] * Vector<3>(corners().col(v)));
      }
    }
    return result;
  }
};

TEST_F(GltfDocumentTest, SkinsPoseTheirMesh) {
  for (const bool is_reversed : {false, true}) {
    for (const bool has_two_sets : {false, true}) {
      const Skinned skinned(is_reversed, has_two_sets);
      EXPECT_LT((points(skinned.file) - skinned.posed()).norm(), 1e-6)
          << is_reversed << has_two_sets;
    }
  }
}

TEST_F(GltfDocumentTest, NormalsTurnWithTheJoints) {
  Skinned skinned;
  skinned.file.primitive(0)["attributes"]["NORMAL"] =
      skinned.file.add<float>(Points(Vector<3>::UnitX().replicate(1, 4)));
  const auto file = read(skinned.file);
  // The second corner has the second joint alone, which turns x to y.
  EXPECT_LT((file.model().attributes.normals.col(0) - Vector<3>::UnitX()).norm(), 1e-6);
  EXPECT_LT((file.model().attributes.normals.col(1) - Vector<3>::UnitY()).norm(), 1e-6);
}

TEST_F(GltfDocumentTest, RigidPartsHangOnJoints) {
  Skinned skinned;
  auto& json = skinned.file.json;
  json["nodes"].push_back({{"mesh", 1}});
  json["nodes"][2]["children"] = {3};
  json["meshes"].push_back({{"primitives", Json::array({Json::object()})}});
  skinned.file.primitive(1)["attributes"]["POSITION"] =
      skinned.file.primitive(0)["attributes"]["POSITION"];
  skinned.file.primitive(1)["indices"] = skinned.file.primitive(0)["indices"];
  const auto all = points(skinned.file);
  for (int v = 0; v < 4; ++v) {
    const Vector<3> expected = skinned.nodes[1] * Vector<3>(corners().col(v));
    EXPECT_LT((all.colwise() - expected).colwise().norm().minCoeff(), 1e-6) << v;
  }
}

TEST_F(GltfDocumentTest, DamagedSkinsAreRefused) {
  Skinned skinned;
  skinned.file.json["skins"][0]["joints"] = {1};
  refuse(skinned.file, "a joint that is out of range");
  skinned.file.json["skins"][0]["joints"] = Json::array();
  refuse(skinned.file, "has no joints");
  skinned.file.json["skins"][0]["joints"] = {1, 7};
  refuse(skinned.file, "array index 7 is out of range");
  skinned.file.json["skins"][0]["joints"] = {1, 2, 0};
  refuse(skinned.file, "fewer inverse bind matrices");
}

TEST_F(GltfDocumentTest, PosedVerticesMoveInTheirPose) {
  const Skinned skinned;
  const auto file = read(skinned.file);
  PointList<3> wanted = points(file);
  wanted.row(1) *= 2;
  wanted.row(0).array() += 0.25;
  const auto result = moved(file, wanted);
  EXPECT_LT((moved_points() - wanted).norm(), 1e-5);
  EXPECT_EQ(result.json["skins"], skinned.file.json["skins"]);
}

// ------------------------------------------------------------------------ morph targets, mirrored

TEST_F(GltfDocumentTest, DefaultWeightsOfMorphTargets) {
  auto file = tetrahedron();
  const Points first = Points::Constant(3, 4, 0.5), second = Points::Constant(3, 4, 0.25);
  file.primitive(0)["targets"] = {{{"POSITION", file.add<float>(first)}},
                                  {{"POSITION", file.add<float>(second)}}};
  EXPECT_EQ(points(file), corners());
  file.json["meshes"][0]["weights"] = {1, 2};
  EXPECT_LT((points(file) - corners() - first - 2 * second).norm(), 1e-6);
  file.json["nodes"][0]["weights"] = {0, 1};
  EXPECT_LT((points(file) - corners() - second).norm(), 1e-6);
  // The result has its default weights, too.
  const auto before = read(file);
  const PointList<3> wanted = (points(before).array() * 3).matrix();
  moved(before, wanted);
  EXPECT_LT((moved_points() - wanted).norm(), 1e-5);
}

TEST_F(GltfDocumentTest, MirrorImagesKeepTheirFront) {
  auto file = tetrahedron();
  EXPECT_GT(volume(read(file).model().soup), 0);
  file.json["nodes"][0]["scale"] = {-1, 1, 1};
  EXPECT_NEAR(volume(read(file).model().soup), 1.0 / 6, 1e-6);
  file.json["nodes"][0]["scale"] = {-1, -1, 1};
  EXPECT_NEAR(volume(read(file).model().soup), 1.0 / 6, 1e-6);
}

TEST_F(GltfDocumentTest, MeshesWithoutVolumeAreSkipped) {
  auto file = tetrahedron();
  for (const double size : {0.0, 1.0}) {
    file.json["nodes"].push_back(
        {{"mesh", 0}, {"scale", {size, 1, 1}}, {"translation", {5, 0, 0}}});
  }
  file.json["scenes"][0]["nodes"] = {0, 1, 2};
  const auto model = read(file).model();
  EXPECT_EQ(model.soup.polygons.size(), 8U);
  ASSERT_EQ(model.notes.size(), 1U);
  expect_piece(model.notes[0], "a scale of 0");
  // The node of a skinned mesh does not count.
  Skinned skinned;
  skinned.file.json["nodes"][0]["scale"] = {0, 0, 0};
  EXPECT_LT((points(skinned.file) - skinned.posed()).norm(), 1e-6);
}

// ------------------------------------------------------------------------- accessors, addresses

TEST_F(GltfDocumentTest, AccessorsWithoutABufferViewAreZeros) {
  auto file = tetrahedron();
  file.json["accessors"].push_back({{"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
  file.primitive(0)["attributes"]["TEXCOORD_0"] = 2;
  const auto model = read(file).model();
  EXPECT_EQ(model.attributes.texture_coordinates,
            (PointList<2>(2, 4) << 0, 0, 0, 0, 1, 1, 1, 1).finished());
}

TEST_F(GltfDocumentTest, SparseAccessorsAreFilledIn) {
  auto file = tetrahedron();
  const auto indices = file.add<std::uint16_t>(Eigen::RowVectorXd::Constant(1, 3));
  const auto values = file.add<float>(Points(Vector<3>(0, 0, 5)));
  const auto view_of = [&](std::size_t accessor) {
    return file.json["accessors"][accessor]["bufferView"];
  };
  auto& positions = file.json["accessors"][0];
  positions["sparse"] = {{"count", 1},
                         {"indices", {{"bufferView", view_of(indices)}, {"componentType", 5123}}},
                         {"values", {{"bufferView", view_of(values)}}}};
  auto expected = corners();
  expected.col(3) << 0, 0, 5;
  EXPECT_EQ(points(file), expected);
  positions["sparse"]["count"] = 4;
  refuse(file, "accessor 0 ends outside its buffer view");
}

TEST_F(GltfDocumentTest, AddressesAreDecoded) {
  auto file = tetrahedron();
  file.json["buffers"][0]["uri"] = "My%20Model%2b.bin";
  file.json["buffers"][0]["byteLength"] = file.bytes.size();
  make("a.gltf", file.json.dump());
  make("My Model+.bin", file.bytes);
  const ModelFile text(path("a.gltf"));
  EXPECT_EQ(points(text), corners());
  expect_error<InputError>([&] { moved(text, 2 * points(text)); },
                           {"a.gltf", "write .glb or another format"});
}

// RFC 2397, in any case of letters.
TEST_F(GltfDocumentTest, AddressesMayHoldTheirData) {
  auto file = tetrahedron();
  std::string percent;
  for (const char c : file.bytes) {
    char code[4];
    std::snprintf(code, sizeof code, "%%%02x", static_cast<unsigned char>(c));
    percent += code;
  }
  file.json["buffers"][0]["byteLength"] = file.bytes.size();
  for (const std::string head : {"data:application/octet-stream,", "DATA:,"}) {
    file.json["buffers"][0]["uri"] = head + percent;
    make("a.gltf", file.json.dump());
    EXPECT_EQ(io::to_points<3>(ModelFile(path("a.gltf")).model().soup, ""), corners());
  }
  file.json["buffers"][0] = {{"byteLength", 3}, {"uri", "DATA:;BASE64,AAAA"}};
  refuse(file, "buffer view 0 ends outside its buffer");  // not: no such file
  file.json["buffers"][0]["uri"] = "blob:" + std::string(2000, 'x');
  make("bad.gltf", file.json.dump());
  expect_error<InputError>([&] { ModelFile(path("bad.gltf")); },
                           {"the address \"blob:xx", "...\" is no file"});
}

// --------------------------------------------------------------------------- what is not
// understood

TEST_F(GltfDocumentTest, ScenesWithoutAMeshSayWhy) {
  auto file = tetrahedron();
  file.json["nodes"] = Json::array();
  file.json["scenes"] = {Json::object()};
  refuse(file, "1 mesh, but no node of the scene uses");
  file.json["scenes"] = Json::array();
  refuse(file, "1 mesh, but no node of the scene uses");
  file.json.erase("meshes");
  refuse(file, "has no meshes");
  // Without a scene all nodes count.
  auto all = tetrahedron();
  all.json["scenes"] = Json::array();
  EXPECT_EQ(points(all), corners());
}

TEST_F(GltfDocumentTest, NodesCountOnce) {
  auto file = tetrahedron();
  file.json["scenes"][0]["nodes"] = {0, 0};
  EXPECT_EQ(read(file).model().soup.polygons.size(), 4U);
  file.json["nodes"].push_back({{"children", {0, 0}}});
  file.json["scenes"][0]["nodes"] = {1};
  refuse(file, "node 0 has two parents");
}

TEST_F(GltfDocumentTest, WhatIsNotReadIsNoted) {
  const auto note_of = [&](const NewGlb& file) {
    const auto notes = read(file).model().notes;
    return notes.size() == 1 ? notes[0] : std::to_string(notes.size()) + " notes";
  };
  auto scenes = tetrahedron();
  scenes.json["scenes"].push_back(scenes.json["scenes"][0]);
  scenes.json["scene"] = 1;
  EXPECT_EQ(note_of(scenes), "only scene 1 of 2 is read");
  auto flat = tetrahedron();
  flat.primitive(0)["indices"] =
      flat.add<std::uint16_t>((Eigen::RowVectorXd(15) << kFaces, 0, 1, 0).finished());
  EXPECT_EQ(note_of(flat), "1 triangle without area is left out");
  EXPECT_EQ(read(flat).model().soup.polygons.size(), 4U);
  Skinned skinned;
  auto& attributes = skinned.file.primitive(0)["attributes"];
  Points weights = Points::Zero(4, 4);
  weights.row(0).setOnes();
  weights(1, 2) = -0.125;
  attributes["WEIGHTS_0"] = skinned.file.add<float>(weights);
  EXPECT_EQ(note_of(skinned.file), "vertex 2 of a mesh has a negative weight");
  weights(1, 2) = std::numeric_limits<double>::infinity();
  attributes["WEIGHTS_0"] = skinned.file.add<float>(weights);
  refuse(skinned.file, "vertex 2 of a mesh has a weight that is not finite");
}

TEST_F(GltfDocumentTest, OtherVersionsAndMissingChunksAreNamed) {
  const auto whole = tetrahedron().glb();
  for (const int version : {1, 3}) {
    auto other = whole;
    other[4] = static_cast<char>(version);
    make("bad.glb", other);
    expect_error<InputError>([&] { ModelFile(path("bad.glb")); },
                             {"version " + std::to_string(version) + " is not supported"});
    auto file = tetrahedron();
    file.json["asset"]["version"] = std::to_string(version) + ".0";
    refuse(file, "version " + std::to_string(version) + " is not supported");
  }
  auto huge = whole;
  huge.replace(4, 4, "\xFF\xFF\xFF\xFF");
  make("bad.glb", huge);
  expect_error<InputError>([&] { ModelFile(path("bad.glb")); }, {"version 4.29497e+09 is not"});
  std::uint32_t size = 0;
  std::memcpy(&size, whole.data() + 12, sizeof size);
  auto cut = whole.substr(0, 20 + size);
  make("bad.glb", cut);
  expect_error<InputError>([&] { ModelFile(path("bad.glb")); },
                           {"it has " + std::to_string(cut.size()) + " of " +
                            std::to_string(whole.size()) + " bytes; copy or export it again"});
  size += 20;
  std::memcpy(cut.data() + 8, &size, sizeof size);
  make("bad.glb", cut);
  expect_error<InputError>([&] { ModelFile(path("bad.glb")); }, {"the binary chunk is missing"});
}

TEST_F(GltfDocumentTest, FilesWithoutTheirBuffersAreNamed) {
  auto file = tetrahedron();
  file.json["buffers"][0]["uri"] = "gone%21.bin";
  make("lost.glb", file.glb());
  expect_error<IoError>([&] { ModelFile(path("lost.glb")); }, {"lost.glb: ", "gone!.bin"});
}

// ---------------------------------------------------------------------- what is not understood

TEST_F(GltfDocumentTest, ExtensionsAreRefusedOrNoted) {
  auto file = tetrahedron();
  for (const std::string name :
       {"EXT_mesh_gpu_instancing", "KHR_texture_transform", "VENDOR_unheard_of"}) {
    file.json["extensionsUsed"] = {name};
    file.json.erase("extensionsRequired");
    const auto notes = read(file).model().notes;
    ASSERT_EQ(notes.size(), 1U);
    expect_piece(notes[0], name);
    file.json["extensionsRequired"] = {name};
    refuse(file, name);
  }
  file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"EXT_meshopt_compression"};
  refuse(file, "EXT_meshopt_compression, which is not supported; export the model uncompressed");
  file.json.erase("extensionsRequired");
  EXPECT_TRUE(read(file).model().notes.empty());
  file.json["extensionsUsed"] = file.json["extensionsRequired"] = {
      "KHR_mesh_quantization", "KHR_materials_unlit", "EXT_texture_webp",
      "EXT_texture_avif",      "KHR_texture_basisu",  "KHR_texture_ktx",
      "GOOGLE_texture_basis",  "KHR_techniques_webgl"};
  EXPECT_TRUE(read(file).model().notes.empty());
}

TEST_F(GltfDocumentTest, PrimitivesWithoutTrianglesAreNamed) {
  auto file = tetrahedron();
  auto points = file.primitive(0);
  points.erase("indices");
  points["mode"] = 0;
  file.json["meshes"][0]["primitives"].push_back(points);
  points["mode"] = 1;
  file.json["meshes"][0]["primitives"].push_back(points);
  const auto model = read(file).model();
  ASSERT_EQ(model.notes.size(), 1U);
  expect_piece(model.notes[0], "points and lines");
  EXPECT_EQ(model.soup.polygons.size(), 4U);
  file.json["meshes"][0]["primitives"].erase(0);
  refuse(file, "has points and lines, but no triangles");
}

// ----------------------------------------------------------------------------------------- editing

// A file with everything that has nothing to do with where vertices are.
NewGlb painted() {
  auto file = tetrahedron();
  auto& json = file.json;
  auto& attributes = file.primitive(0)["attributes"];
  attributes["NORMAL"] = file.add<float>(Points(Vector<3>(0.6, 0, 0.8).replicate(1, 4)));
  attributes["TANGENT"] = file.add<float>(Points(Eigen::Vector4d(0, 1, 0, -1).replicate(1, 4)));
  attributes["TEXCOORD_0"] = file.add<float>(Points::Random(2, 4));
  attributes["TEXCOORD_1"] = file.add<float>(Points::Random(2, 4));
  attributes["COLOR_0"] = file.add<std::uint8_t>(Points::Constant(4, 4, 77));
  json["accessors"].back()["normalized"] = true;
  file.primitive(0)["targets"] = {{{"POSITION", file.add<float>(Points::Constant(3, 4, 0.5))}}};
  file.primitive(0)["material"] = 0;
  json["materials"] = Json::parse(R"([{"name":"leaf","alphaMode":"MASK","alphaCutoff":0.25,
    "normalTexture":{"index":0,"texCoord":1},"emissiveFactor":[0.1,0.2,0.3],
    "pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0.5,1],"baseColorTexture":{"index":0}},
    "extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":0.125}},"extras":{"a":[1,2]}}])");
  json["images"].push_back(
      {{"bufferView", file.add_view("\x89PNG\r\n\x1a\nodd")}, {"mimeType", "image/png"}});
  json["textures"] = {{{"source", 0}}};
  json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.01}}}}};
  json["nodes"].push_back({{"name", "eye"}, {"camera", 0}, {"translation", {0, 0, 9}}});
  json["scenes"][0]["nodes"].push_back(1);
  json["extensionsUsed"] = {"KHR_materials_clearcoat"};
  return file;
}

// What may change for a primitive is left out.
Json without_accessors(Json json) {
  for (auto& accessor : json["accessors"]) {
    accessor.erase("min");
    accessor.erase("max");
  }
  json.erase("buffers");
  return json;
}

TEST_F(GltfDocumentTest, OnlyWhatMovesChanges) {
  std::mt19937 random(7);
  const auto original = painted();
  const auto file = read(original);
  const GlbChunks before(original.glb());
  const auto rest = points(file);
  const std::set<std::size_t> edited{0, 2, 3, 7};  // position, normal, tangent, morph target
  for (int round = 0; round < 20; ++round) {
    PointList<3> wanted = rest;
    std::uniform_real_distribution<double> number(-1, 1);
    for (double& value : wanted.reshaped()) value += 0.3 * number(random);
    const auto after = moved(file, wanted);
    EXPECT_EQ(without_accessors(after.json), without_accessors(before.json));
    for (std::size_t k = 0; k < before.json["accessors"].size(); ++k) {
      if (edited.count(k) > 0) continue;
      EXPECT_EQ(after.accessor(k), before.accessor(k)) << k;
    }
    EXPECT_EQ(after.view(before.json["images"][0]["bufferView"]), "\x89PNG\r\n\x1a\nodd");
    EXPECT_LT((moved_points() - wanted).norm(), 1e-6);
    // Tangents stay directions on the surface.
    const auto normals = after.floats(2, 3), tangents = after.floats(3, 4);
    for (int v = 0; v < 4; ++v) {
      EXPECT_NEAR(tangents.col(v).head<3>().norm(), 1, 1e-6);
      EXPECT_NEAR(tangents.col(v).head<3>().dot(normals.col(v)), 0, 1e-6);
      EXPECT_EQ(tangents(3, v), -1);
    }
  }
}

// Reading counts them as missing.
TEST_F(GltfDocumentTest, OnlyPositionsMustBeFinite) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  auto original = tetrahedron();
  Points normals = Vector<3>::UnitZ().replicate(1, 4);
  Points tangents = Eigen::Vector4d::Unit(0).replicate(1, 4);
  normals.col(2).setConstant(kNone);
  tangents.col(1).setConstant(kNone);
  auto& attributes = original.primitive(0)["attributes"];
  attributes["NORMAL"] = original.add<float>(normals);
  attributes["TANGENT"] = original.add<float>(tangents);
  original.json["accessors"][2]["min"] = original.json["accessors"][2]["max"] = {0, 0, 1};
  const auto file = read(original);
  const PointList<3> rest = points(file), wanted = 2 * rest;
  const auto after = moved(file, wanted);
  EXPECT_EQ(points(original), rest);
  EXPECT_EQ(moved_points(), wanted);
  EXPECT_NEAR(after.floats(attributes["NORMAL"], 3)(2, 0), 1, 1e-6);
  EXPECT_TRUE(after.floats(attributes["NORMAL"], 3).allFinite());
  EXPECT_TRUE(after.floats(attributes["TANGENT"], 4).allFinite());
  EXPECT_EQ(after.json["accessors"][2]["min"][2], 0.0);
  expect_error<InputError>([&] { moved(file, 1e39 * rest); }, {"not finite or too large"});
}

TEST_F(GltfDocumentTest, TangentsAndMorphTargetsTurnAlong) {
  auto original = painted();
  original.json["nodes"][0]["scale"] = {2, 1, 1};
  original.json["nodes"][0]["rotation"] = {0, std::sqrt(0.5), 0, std::sqrt(0.5)};
  const Eigen::Affine3d node =
      Eigen::Quaterniond(std::sqrt(0.5), 0, std::sqrt(0.5), 0) * Eigen::Scaling(2.0, 1.0, 1.0);
  const auto file = read(original);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector<3>(1, 2, 3).normalized()).matrix();
  const PointList<3> wanted = turn * points(file);
  const auto after = moved(file, wanted);
  const auto tangents = after.floats(3, 4), targets = after.floats(7, 3);
  for (int v = 0; v < 4; ++v) {
    const Vector<3> target = node.linear() * targets.col(v).cast<double>();
    EXPECT_LT((target - turn * node.linear() * Vector<3>::Constant(0.5)).norm(), 1e-6);
    const Vector<3> tangent = node.linear() * tangents.col(v).head<3>().cast<double>();
    EXPECT_LT((tangent.normalized() - turn * Vector<3>::UnitY()).norm(), 1e-5);
  }
}

// The surface is n x t, and textures run along t and w n x t, wherever the vertices are.
TEST_F(GltfDocumentTest, TangentsKeepTheirSideOfTheTexture) {
  const auto original = painted();  // w = -1
  const auto file = read(original);
  const GlbChunks before(original.glb());
  Eigen::Matrix3d mirror = Vector<3>(-1, 1, 1).asDiagonal();
  Eigen::Matrix3d shear;
  shear << -1, 0.25, 0.5,  //
      0.5, 3, 0,           //
      0, -0.5, 0.5;
  for (const Eigen::Matrix3d& map : {mirror, shear}) {
    const auto after = moved(file, map * io::to_points<3>(file.model().soup, ""));
    for (int v = 0; v < 4; ++v) {
      const auto frame = [&](const GlbChunks& chunks) {
        return std::pair(Vector<3>(chunks.floats(2, 3).col(v).cast<double>()),
                         Eigen::Vector4d(chunks.floats(3, 4).col(v).cast<double>()));
      };
      const auto [n, t] = frame(before);
      const auto [normal, tangent] = frame(after);
      // The triangles keep their corners, so that their front is where the cofactors say.
      const Vector<3> expected = map.determinant() * map.inverse().transpose() * n;
      EXPECT_LT((normal - expected.normalized()).norm(), 1e-5);
      const Vector<3> across = map * n.cross(t.head<3>()) * t[3];
      EXPECT_GT(across.dot(normal.cross(tangent.head<3>()) * tangent[3]), 0);
    }
  }
}

// Moved vertices do not fit into whole numbers, which nothing needs then.
TEST_F(GltfDocumentTest, WhatIsReplacedGoes) {
  auto original = painted();
  const auto old = original.primitive(0)["attributes"]["POSITION"].get<std::size_t>();
  const auto whole = original.add<std::uint8_t>(Points(3 * corners()));
  original.primitive(0)["attributes"]["POSITION"] = whole;
  original.json["extensionsUsed"].push_back("KHR_mesh_quantization");
  const GlbChunks before(original.glb());
  ASSERT_EQ(before.unused()[0], std::set<std::size_t>{old});
  const auto file = read(original);
  const PointList<3> wanted = 1.1 * points(file);
  for (const bool is_known : {true, false}) {
    if (!is_known) original.json["extensionsUsed"].push_back("VENDOR_knows_accessors");
    const auto after = moved(read(original), wanted);
    EXPECT_EQ(after.unused()[0].size(), is_known ? 1U : 2U);
    EXPECT_EQ(after.unused()[1].size(), 0U);
    EXPECT_EQ(after.accessor(old), before.accessor(old));
    const auto& attributes = after.json["meshes"][0]["primitives"][0]["attributes"];
    for (const char* name : {"TEXCOORD_0", "TEXCOORD_1", "COLOR_0"}) {
      const auto& numbers = before.json["meshes"][0]["primitives"][0]["attributes"];
      EXPECT_EQ(after.accessor(attributes[name]), before.accessor(numbers[name])) << name;
    }
    EXPECT_LT((moved_points() - wanted).norm(), 1e-5);
  }
}

// Readers that decode them would show the old places.
TEST_F(GltfDocumentTest, CompressedCopiesOfWhatMovesGo) {
  auto original = tetrahedron();
  const char* const name = "KHR_draco_mesh_compression";
  original.json["nodes"].push_back({{"mesh", 1}, {"translation", {5, 0, 0}}});
  original.json["scenes"][0]["nodes"].push_back(1);
  original.json["meshes"].push_back(original.json["meshes"][0]);
  original.json["extensionsUsed"] = {name};
  for (const std::size_t mesh : {0U, 1U}) {
    const auto view = original.add_view("compressed_" + std::to_string(mesh));
    original.primitive(mesh)["extensions"][name] = {{"bufferView", view},
                                                    {"attributes", {{"POSITION", 0}}}};
  }
  const auto file = read(original);
  const auto rest = points(file);
  PointList<3> wanted = rest;
  wanted.leftCols(4) *= 2;
  auto after = moved(file, wanted);
  EXPECT_FALSE(after.json["meshes"][0]["primitives"][0].contains("extensions"));
  const auto& kept = after.json["meshes"][1]["primitives"][0]["extensions"][name];
  EXPECT_EQ(after.view(kept["bufferView"]), "compressed_1");
  EXPECT_EQ(after.binary.find("compressed_0"), std::string::npos);
  EXPECT_EQ(after.json["extensionsUsed"], original.json["extensionsUsed"]);
  after = moved(file, 2 * rest);
  EXPECT_EQ(after.json.dump().find(name), std::string::npos);
  EXPECT_FALSE(after.json.contains("extensionsUsed"));
  EXPECT_EQ(after.binary.find("compressed"), std::string::npos);
}

// Their fallback is in another buffer, as gltfpack -cf writes it.
TEST_F(GltfDocumentTest, CompressedCopiesOfBufferViewsGo) {
  for (const std::string name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    auto original = painted();
    original.add_view("compressed");
    auto& json = original.json;
    const auto copy = json["bufferViews"].back();
    json["bufferViews"].erase(json["bufferViews"].size() - 1);
    json["extensionsUsed"].push_back(name);
    for (auto& view : json["bufferViews"]) {
      view["extensions"][name] = copy;
      view["extensions"][name]["mode"] = "ATTRIBUTES";
      view["buffer"] = 1;
    }
    make("fallback.bin", original.bytes);
    json["buffers"].push_back({{"uri", "fallback.bin"},
                               {"byteLength", original.bytes.size()},
                               {"extensions", {{name, {{"fallback", true}}}}}});
    const auto file = read(original);
    const PointList<3> wanted = 2 * points(file);
    const auto after = moved(file, wanted);
    EXPECT_EQ(after.json.dump().find("meshopt"), std::string::npos);
    EXPECT_EQ(after.binary.find("compressed"), std::string::npos);
    EXPECT_EQ(after.json["buffers"].size(), 1U);
    EXPECT_LT((moved_points() - wanted).cwiseAbs().maxCoeff(), 1e-6);
  }
}

// Equal numbers are often stored once.
TEST_F(GltfDocumentTest, MorphTargetsThatShareNumbersTurnOnce) {
  auto original = tetrahedron();
  const auto shared = original.add<float>(Points(Vector<3>::UnitX().replicate(1, 4)));
  original.primitive(0)["targets"] = {{{"POSITION", shared}}, {{"POSITION", shared}}};
  const auto file = read(original);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(M_PI / 2, Vector<3>::UnitZ()).matrix();
  const auto after = moved(file, turn * points(file));
  for (const auto& target : after.json["meshes"][0]["primitives"][0]["targets"]) {
    const auto offsets = after.floats(target["POSITION"], 3);
    EXPECT_LT((offsets.col(1).cast<double>() - Vector<3>::UnitY()).norm(), 1e-6);
  }
}

// Names of people's models end so.
TEST_F(GltfDocumentTest, VrmIsReadAsGlb) {
  EXPECT_EQ(io::to_points<3>(read(tetrahedron(), "a.vrm").model().soup, ""), corners());
}

TEST_F(GltfDocumentTest, PicturesNextToBinaryDocumentsAreEmbedded) {
  auto original = painted();
  make("odd.png", "\x89PNG\r\n\x1a\npicture");
  original.json["images"] = {{{"uri", "odd.png"}}, {{"uri", "gone.png"}}};
  const auto file = read(original);
  const auto after = moved(file, 2 * points(file));
  EXPECT_EQ(after.view(after.json["images"][0]["bufferView"]), "\x89PNG\r\n\x1a\npicture");
  EXPECT_EQ(after.json["images"][1], original.json["images"][1]);
  const auto lost = io::losses(file.model(), "b.glb");
  ASSERT_EQ(lost.size(), 1U);
  expect_piece(lost[0], "gone.png");
}

// With pictures of all kinds, whatever the extension is that names them.
TEST_F(GltfDocumentTest, TextDocumentsBecomeBinaryOnesWithAllTheyHave) {
  const std::vector<std::pair<std::string, std::string>> pictures{
      {"image/png", "\x89PNG\r\n\x1a\npicture"},
      {"image/webp", "RIFF1234WEBPodd"},
      {"image/avif", std::string("\0\0\0\x1c", 4) + "ftypavifodd"},
      {"image/ktx2", "\xabKTX 20\xbbodd"}};
  auto original = painted();
  original.json["buffers"][0] = {{"uri", "a.bin"}, {"byteLength", original.bytes.size()}};
  original.json["images"] = Json::array();
  for (const auto& [type, bytes] : pictures) {
    make("odd " + type.substr(6), bytes);
    original.json["images"].push_back({{"uri", "odd%20" + type.substr(6)}, {"name", type}});
  }
  make("a.bin", original.bytes);
  make("a.gltf", original.json.dump());
  const ModelFile file(path("a.gltf"));
  EXPECT_TRUE(io::losses(file.model(), "b.glb").empty());
  io::write_model(path("b.glb"), file.model());
  const GlbChunks after(content("b.glb"));
  EXPECT_EQ(after.json["materials"], original.json["materials"]);
  EXPECT_EQ(after.json["cameras"], original.json["cameras"]);
  EXPECT_EQ(after.binary.substr(0, original.bytes.size()), original.bytes);
  ASSERT_EQ(after.json["images"].size(), pictures.size());
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    const auto& image = after.json["images"][k];
    EXPECT_EQ(image["mimeType"], pictures[k].first);
    EXPECT_EQ(image["name"], pictures[k].first);
    EXPECT_EQ(after.view(image["bufferView"]), pictures[k].second);
  }
}

}  // namespace
}  // namespace flbc::testing
