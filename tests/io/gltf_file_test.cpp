// SPDX-License-Identifier: BSD-3-Clause
// glTF files as models.
#include <array>
#include <cstdint>
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

// A square of two triangles whose diagonal is a seam, so that its ends are in the file twice.
struct Square : NewGlb {
  const std::string picture = "\x89PNG\r\n\x1a\nnot really";

  explicit Square(const std::array<int, 6>& indices = {0, 1, 2, 3, 4, 5})
      : NewGlb(R"({"scene":0,"scenes":[{"nodes":[0]}],
      "nodes":[{"children":[1],"translation":[10,0,0]},
               {"mesh":0,"rotation":[0,0,0.7071067811865476,0.7071067811865476],"scale":[2,2,2]}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3,
                                "material":0}]}],
      "materials":[{"name":"paint","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,1,1],
        "baseColorTexture":{"index":0},"metallicFactor":0,"roughnessFactor":0.5}}],
      "textures":[{"source":0}],"images":[{"bufferView":4,"mimeType":"image/png"}]})") {
    add<float>((Eigen::MatrixXd(3, 6) << 0, 1, 1, 0, 1, 0,  //
                0, 0, 1, 0, 1, 1,                           //
                0, 0, 0, 0, 0, 0)
                   .finished());
    add<float>(Eigen::MatrixXd(Vector<3>::UnitZ().replicate(1, 6)));
    add<float>((Eigen::MatrixXd(2, 6) << 0, 0.5, 0.5, 0.5, 1, 0.5,  //
                0, 0, 1, 0, 1, 1)
                   .finished());
    add<std::uint16_t>(Eigen::Map<const Eigen::RowVectorXi>(indices.data(), 6));
    add_view(picture);
    bytes.resize((bytes.size() + 3) / 4 * 4);
  }
};

// Where the nodes put the points of the file.
const PointList<3> kCorners = (PointList<3>(3, 4) << 10, 10, 8, 8,  //
                               0, 2, 2, 0,                          //
                               0, 0, 0, 0)
                                  .finished();

class GltfFileTest : public FormatTest {
 protected:
  static std::string rewritten(const ModelFile& file, const PointList<3>& points) {
    std::ostringstream out;
    file.write<3>(out, points);
    return out.str();
  }
  void refuse(const Square& square, const std::string& message) {
    make("bad.glb", square.glb());
    expect_error<InputError>([&] { ModelFile(path("bad.glb")); }, {"bad.glb", message});
  }
};

TEST_F(GltfFileTest, SeamsAreOneVertexInTheFrameOfTheScene) {
  make("a.glb", Square().glb());
  const ModelFile file(path("a.glb"));
  const auto& model = file.model();
  EXPECT_LT((io::to_points<3>(model.soup, "") - kCorners).norm(), 1e-12);
  EXPECT_EQ(model.soup.polygons, (std::vector<std::vector<Index>>{{0, 1, 2}, {0, 2, 3}}));
  const auto& attributes = model.attributes;
  ASSERT_EQ(attributes.corners.size(), 2U);
  EXPECT_NE(attributes.corners[0][0].texture_coordinate,
            attributes.corners[1][0].texture_coordinate);
  EXPECT_EQ(attributes.texture_coordinates.col(attributes.corners[0][2].texture_coordinate),
            Vector<2>(0.5, 0));  // the second axis points up
  ASSERT_EQ(model.materials.size(), 1U);
  EXPECT_EQ(model.materials[0].name, "paint");
  EXPECT_EQ(model.materials[0].color, Vector<3>(0.5, 0.25, 1));
  EXPECT_EQ(model.materials[0].picture, Square().picture);
  EXPECT_EQ(model.polygon_materials, (std::vector<Index>{0, 0}));
}

TEST_F(GltfFileTest, PointsMoveAndAllElseStays) {
  const Square square;
  make("a.glb", square.glb());
  const ModelFile file(path("a.glb"));
  const auto points = io::to_points<3>(file.model().soup, "");
  EXPECT_EQ(rewritten(file, points), square.glb());
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5, Vector<3>::UnitX()).toRotationMatrix();
  const PointList<3> moved = turn * points;
  make("b.glb", rewritten(file, moved));
  const ModelFile again(path("b.glb"));
  EXPECT_LT((io::to_points<3>(again.model().soup, "") - moved).cwiseAbs().maxCoeff(), 1e-5);
  for (const auto& normal : again.model().attributes.normals.colwise()) {
    EXPECT_LT((normal.normalized() - turn * Vector<3>::UnitZ()).norm(), 1e-6);
  }
  EXPECT_EQ(again.model().materials[0].picture, square.picture);
  EXPECT_EQ(again.model().attributes.texture_coordinates,
            file.model().attributes.texture_coordinates);

  // The bounds are those of the points in the file, which node and parent scale, turn, and shift.
  const auto accessor = GlbChunks(content("b.glb")).json["accessors"][0];
  EXPECT_NEAR(accessor["max"][0], std::cos(0.5), 1e-6);
  EXPECT_NEAR(accessor["max"][2], std::sin(0.5), 1e-6);
}

TEST_F(GltfFileTest, ModelsAreWrittenWithTheirMaterials) {
  make("a.png", Square().picture);
  make("a.mtl", "newmtl paint\nKd 0 0 0\nd 0.5\nmap_Kd a.png\nnewmtl other\nKd 0 0 1\n");
  const auto obj =
      make("a.obj",
           "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0.5\nvt 0 0\nvt 1 0\nvt 1 1\n"
           "vt 0 1\nvt 0.5 0.25\nvn 0 0 1\nusemtl paint\nf 1/1/1 2/2/1 3/3/1 4/4/1\n"
           "usemtl other\nf 2/5/1 5/2/1 3/3/1\n");
  const ModelFile before(obj);
  write_model(path("b.glb"), before.model());
  const ModelFile after(path("b.glb"));
  const auto& [a, b] = std::tie(before.model(), after.model());
  EXPECT_EQ(b.soup.points, a.soup.points);
  EXPECT_EQ(b.soup.polygons.size(), 3U);
  ASSERT_EQ(b.materials.size(), 2U);
  EXPECT_EQ(b.materials[0].name, "paint");
  EXPECT_EQ(b.materials[0].opacity, 0.5);
  EXPECT_EQ(b.materials[0].picture, Square().picture);
  EXPECT_EQ(b.materials[0].tint, Vector<3>(1, 1, 1));  // not black
  EXPECT_LT((b.materials[1].color - a.materials[1].color).norm(), 1e-7);
  EXPECT_EQ(b.polygon_materials, (std::vector<Index>{0, 0, 1}));
  EXPECT_EQ(b.attributes.texture_coordinates.col(b.attributes.corners[2][0].texture_coordinate),
            Vector<2>(0.5, 0.25));
  EXPECT_EQ(io::losses(a, path("b.glb")), a.others);
}

// By which pictures are multiplied, whichever file they are in.
TEST_F(GltfFileTest, ColorsOfMaterialsTintTheirPictures) {
  for (const bool is_apart : {false, true}) {
    Square square;
    make("a.png", square.picture);
    if (is_apart) square.json["images"][0] = {{"uri", "a.png"}};
    make("a.glb", square.glb());
    auto model = ModelFile(path("a.glb")).model();
    model.gltf.reset();  // to be written anew
    write_model(path("b.glb"), model);
    const auto again = ModelFile(path("b.glb")).model().materials.at(0);
    EXPECT_EQ(again.picture, square.picture);
    EXPECT_LT((again.tint - Vector<3>(0.5, 0.25, 1)).norm(), 1e-7);
  }
}

// Each material names the coordinates of its picture.
TEST_F(GltfFileTest, PicturesHaveTheirOwnCoordinates) {
  Square square;
  auto& attributes = square.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["TEXCOORD_1"] = 2;
  attributes["TEXCOORD_0"] = 4;  // others
  square.json["accessors"].push_back(square.json["accessors"][2]);
  square.json["accessors"][4]["bufferView"] = 1;
  auto& texture = square.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  texture["texCoord"] = 1;
  make("a.glb", square.glb());
  const auto model = ModelFile(path("a.glb")).model();
  PointList<2> places(2, 6);
  places << 0, 0.5, 0.5, 0.5, 1, 0.5,  //
      0, 0, 1, 0, 1, 1;
  for (std::size_t f = 0; f < 2; ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& corner = model.attributes.corners[f][k];
      const Vector<2> wanted = places.col(3 * f + k);
      EXPECT_EQ(model.attributes.texture_coordinates.col(corner.texture_coordinate),
                Vector<2>(wanted.x(), 1 - wanted.y()));
    }
  }
  const auto& others = model.others;
  EXPECT_EQ(std::count(others.begin(), others.end(), "TEXCOORD_0"), 1);
  EXPECT_EQ(std::count(others.begin(), others.end(), "TEXCOORD_1"), 0);
}

TEST_F(GltfFileTest, PicturesOfOtherKindsAreNamed) {
  for (const std::string name : {"KHR_texture_basisu", "EXT_texture_webp"}) {
    for (const bool is_required : {false, true}) {
      Square square;
      square.json["extensionsUsed"] = {name};
      if (is_required) square.json["extensionsRequired"] = {name};
      square.json["textures"][0] = {{"extensions", {{name, {{"source", 0}}}}}};
      make("a.glb", square.glb());
      const auto model = ModelFile(path("a.glb")).model();
      ASSERT_EQ(model.notes.size(), 1U);
      expect_piece(model.notes[0], name);
      const auto& others = model.others;
      EXPECT_EQ(std::count(others.begin(), others.end(), "pictures of the extension " + name), 1);
    }
  }
}

TEST_F(GltfFileTest, DamageEndsInMessages) {
  const auto whole = Square().glb();
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    make("bad.glb", whole.substr(0, size));
    EXPECT_THROW(ModelFile(path("bad.glb")), InputError) << size;
  }
  const auto with = [&](const char* pointer, Json value) {
    Square square;
    square.json[Json::json_pointer(pointer)] = std::move(value);
    return square;
  };
  refuse(with("/accessors/0/count", 1000), "accessor 0 ends outside its buffer view");
  refuse(with("/accessors/3/count", std::uint64_t{1} << 62), "accessor 3 ends outside");
  refuse(with("/accessors/0/byteOffset", 10000), "ends outside its buffer");
  refuse(with("/accessors/0/type", "VEC2"),
         "damaged glTF, mesh 0, primitive 0: accessor 0 does not have numbers");
  refuse(with("/accessors/0/sparse", Json::object()), "damaged");
  refuse(with("/nodes/1/children", Json::array({0})), "");
  refuse(with("/nodes/1/scale", Json::array({0, 1, 1})), "but no triangles");
  refuse(with("/meshes/0/primitives/0/material", 7),
         "mesh 0, primitive 0: a material is out of range; export the model again");
  refuse(with("/extensionsRequired", Json::array({"KHR_draco_mesh_compression"})), "uncompressed");
  refuse(Square({0, 1, 2, 3, 6, 5}), "the vertex 6, which is out of range");
}

}  // namespace
}  // namespace flbc::testing
