// SPDX-License-Identifier: BSD-3-Clause
// Joints that skin a cage skin the model in it. The judge reads files by the specification.
#include "gltf/skeleton.h"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "flbc/bounding_box.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "gltf/skin.h"
#include "support/dimensions.h"
#include "support/errors.h"
#include "support/glb_file.h"
#include "support/harmonic_weights.h"
#include "support/new_glb.h"
#include "support/scratch.h"

namespace flbc::testing::rigged {
namespace {

using Frames = std::vector<Eigen::Affine3d>;

// A root that no animation names, and three joints: the second is a child of the first, the third
// has the root as parent. At rest, and at the keys of an animation, as the test has them.
struct Rig {
  static constexpr double kKeys[] = {0, 0.5, 2};

  static Eigen::Affine3d root() {
    return Eigen::Translation3d(1, 0, 0.5) *
           Eigen::AngleAxisd(0.3, Vector<3>(1, 2, -1).normalized()) * Eigen::Scaling(2.0);
  }
  static Eigen::Quaterniond turn(int joint, int key) {
    return Eigen::Quaterniond(
        Eigen::AngleAxisd(0.4 * joint + 0.9 * key, Vector<3>(1, joint, -1).normalized()));
  }
  static Vector<3> move(int joint, double time) { return {0.3 * joint, 0.2 * time, 0.1 * joint}; }

  // \param key  -1: the pose of the nodes
  static Frames places(int key) {
    Frames local;
    for (int j = 0; j < 3; ++j) {
      local.push_back(Eigen::Translation3d(move(j, key < 0 || j != 0 ? 0 : kKeys[key])) *
                      turn(j, key < 0 || j == 2 ? 0 : key));
    }
    return {root() * local[0], root() * local[0] * local[1], root() * local[2]};
  }
};

// The ring, a model in it that has all its vertices, and a rig of its cage.
struct RiggedRing {
  RiggedRing() : sample(make_sample<3>(Shape::kRing, 3)), weights(harmonic_weights(sample)) {
    const auto& mesh = sample.mesh;
    for (Index v = 0; v < mesh.num_vertices(); ++v) surface.sources.push_back(v);
    surface.triangles = mesh.cells.topRows<3>();
    surface.normals = Vector<3>::UnitZ().replicate(1, mesh.num_vertices());
    bones = Eigen::MatrixXd::Random(3, sample.cage.size()).cwiseAbs();
    for (Index i = 0; i < bones.cols(); ++i) bones.col(i) /= bones.col(i).sum();
    binding = bound_by<3>(sample.cage, mesh.points, weights, edges_of_cells(mesh));
  }

  // \param bind  inverse bind matrices \param points  of the file \param interpolation  of the
  // animation; empty for none
  std::string rig(const Frames& bind, const PointList<3>& points,
                  const std::string& interpolation = "LINEAR") const {
    NewGlb file(R"({"scene":0,"scenes":[{"nodes":[0,4]}],"nodes":[{"children":[1,3],"name":"root"},
      {"children":[2],"name":"a"},{"name":"b"},{"name":"c"},{"mesh":0,"skin":0,"name":"cage"}],
      "meshes":[{"primitives":[{}]}],"skins":[{"joints":[1,2,3]}]})");
    const auto root = Rig::root();
    const std::vector<double> matrix(root.data(), root.data() + 16);
    file.json["nodes"][0]["matrix"] = matrix;
    const auto list = [](const auto& v) { return std::vector<double>(v.begin(), v.end()); };
    for (int j = 0; j < 3; ++j) {
      file.json["nodes"][1 + j]["translation"] = list(Rig::move(j, 0));
      file.json["nodes"][1 + j]["rotation"] = list(Rig::turn(j, 0).coeffs());
    }
    // Every vertex twice, as at seams.
    const auto n = points.cols();
    const Eigen::MatrixXd twice = points.replicate(1, 2);
    file.primitive(0)["attributes"]["POSITION"] = file.add<float>(twice);
    Eigen::MatrixXd four = Eigen::MatrixXd::Zero(4, 2 * n);
    four.topRows(3) = bones.replicate(1, 2);
    file.primitive(0)["attributes"]["WEIGHTS_0"] = file.add<float>(four);
    file.primitive(0)["attributes"]["JOINTS_0"] =
        file.add<std::uint8_t>(Eigen::MatrixXd(Eigen::Vector4d(0, 1, 2, 0).replicate(1, 2 * n)));
    file.primitive(0)["indices"] = file.add<std::uint16_t>(
        Eigen::MatrixXd(sample.cage.facets.cast<double>().reshaped(1, sample.cage.facets.size())));
    Eigen::MatrixXd binds(16, 3);
    for (int j = 0; j < 3; ++j) binds.col(j) = bind[j].matrix().reshaped();
    file.json["skins"][0]["inverseBindMatrices"] = file.add<float>(binds);
    if (interpolation.empty()) return file.glb();
    // Turns at three keys; moves of the first joint at two of them, so that one is interpolated.
    const auto keys = file.add<float>(Eigen::RowVector3d(0, 0.5, 2));
    const auto ends = file.add<float>(Eigen::RowVector2d(0, 2));
    NewGlb::Json channels, samplers;
    const auto add = [&](int joint, const char* path, std::size_t input, std::size_t output) {
      channels.push_back(
          {{"sampler", samplers.size()}, {"target", {{"node", 1 + joint}, {"path", path}}}});
      samplers.push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
    };
    for (int j = 0; j < 2; ++j) {
      Eigen::MatrixXd turns(4, 3);
      for (int key = 0; key < 3; ++key) turns.col(key) = Rig::turn(j, key).coeffs();
      add(j, "rotation", keys, file.add<float>(turns));
    }
    Eigen::MatrixXd moves(3, 2);
    moves << Rig::move(0, 0), Rig::move(0, 2);
    add(0, "translation", ends, file.add<float>(moves));
    file.json["animations"].push_back({{"channels", channels}, {"samplers", samplers}});
    return file.glb();
  }

  // Where joints put points by S, and what they do to a point.
  PointList<3> skinned(const Eigen::MatrixXd& shares, const Frames& moves,
                       const PointList<3>& points) const {
    PointList<3> result = PointList<3>::Zero(3, points.cols());
    for (Index p = 0; p < points.cols(); ++p) {
      for (int j = 0; j < 3; ++j) {
        result.col(p) += shares(j, p) * (moves[j] * Vector<3>(points.col(p)));
      }
    }
    return result;
  }

  gltf::ExportedSkin skin(const std::string& file, bool corrects = false) const {
    const ScratchFolder folder;
    const auto path = (folder.path() / "rig.glb").string();
    std::ofstream(path, std::ios::binary) << file;
    return gltf::export_skin(binding, surface, {4}, gltf::read_skeleton(path, sample.cage.points),
                             corrects);
  }

  Sample<3> sample;
  WeightMatrix weights;
  Eigen::MatrixXd bones;
  gltf::Surface surface;
  Binding<3> binding;
};

Frames inverses(const Frames& frames) {
  Frames result;
  for (const auto& frame : frames) result.push_back(frame.inverse());
  return result;
}

Frames products(const Frames& a, const Frames& b) {
  Frames result;
  for (std::size_t j = 0; j < a.size(); ++j) result.push_back(a[j] * b[j]);
  return result;
}

// The vertices of a file at a key: joints by name, with morph targets.
PointList<3> seen(const std::string& content, int key) {
  const GlbFile file(content);
  const auto& skin = file.json["skins"][0];
  const auto places = Rig::places(key);
  const Eigen::MatrixXd binds = file.accessor(skin["inverseBindMatrices"]);
  const auto targets = file.primitive().value("targets", GlbFile::Json::array());
  Eigen::MatrixXd points = file.attribute("POSITION");
  if (key >= 0 && !targets.empty()) {
    const auto& animation = file.json["animations"][0];
    const auto& channel = animation["channels"].back();
    EXPECT_EQ(channel["target"]["path"], "weights");
    const auto& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
    const Eigen::MatrixXd weights = file.accessor(sampler["output"]).reshaped(targets.size(), 3);
    EXPECT_EQ(weights.col(key), Eigen::Vector3d::Unit(key));
    points += file.accessor(targets[key]["POSITION"]);
  }
  const Eigen::MatrixXd joints = file.influences("JOINTS_", true);
  const Eigen::MatrixXd weights = file.influences("WEIGHTS_");
  PointList<3> result = PointList<3>::Zero(3, points.cols());
  for (Eigen::Index v = 0; v < points.cols(); ++v) {
    for (Eigen::Index slot = 0; slot < joints.rows(); ++slot) {
      const auto joint = static_cast<Eigen::Index>(joints(slot, v));
      const std::string name = file.json["nodes"][skin["joints"][joint].get<std::size_t>()]["name"];
      if (weights(slot, v) == 0) continue;
      const Eigen::Affine3d bind(Eigen::Matrix4d(binds.col(joint).reshaped(4, 4)));
      const auto place =
          name == "skeleton" ? Eigen::Affine3d::Identity() : places.at(name[0] - 'a');
      result.col(v) += weights(slot, v) * (place * bind * Vector<3>(points.col(v)));
    }
  }
  return result;
}

double apart(const PointList<3>& a, const PointList<3>& b) {
  return (a - b).colwise().norm().maxCoeff();
}

constexpr double kSingle = 1e-5;

TEST(GltfSkeleton, WeightsAreTheProductAndErrorsThoseOfTheFile) {
  const RiggedRing example;
  const auto& cage = example.sample.cage.points;
  const auto bind = inverses(Rig::places(-1));  // the nodes are at rest
  const auto plain = example.skin(example.rig(bind, cage));
  const auto corrected = example.skin(example.rig(bind, cage), true);
  EXPECT_EQ(plain.joints, 3);
  EXPECT_EQ(plain.moving_joints, 2);
  EXPECT_EQ(plain.keys, 3U);
  const auto shares = compose(example.weights, WeightMatrix(example.bones)).dense();
  double squares = 0, max = 0;
  for (int key = -1; key < 3; ++key) {
    const auto moves = products(Rig::places(key), bind);
    EXPECT_LT(
        apart(seen(plain.content, key), example.skinned(shares, moves, example.sample.mesh.points)),
        kSingle);
    const auto pose = example.skinned(example.bones, moves, cage);
    const auto by_cage = deform<3>(example.weights, pose);
    EXPECT_LT(apart(seen(corrected.content, key), by_cage), kSingle);
    if (key < 0) continue;
    const auto lengths = displacements<3>(seen(plain.content, key), by_cage);
    squares += lengths.squaredNorm() / static_cast<double>(3 * lengths.size());
    max = std::max(max, lengths.maxCoeff());
  }
  EXPECT_GT(max, 0.1);
  EXPECT_NEAR(plain.skeleton_error->max, max, kSingle);
  EXPECT_NEAR(plain.skeleton_error->rms, std::sqrt(squares), kSingle);
  EXPECT_EQ(corrected.skeleton_error->max, plain.skeleton_error->max);
  EXPECT_LT(corrected.corrected_error->max, kSingle);
  EXPECT_FALSE(plain.corrected_error);
}

// The rig was exported in another pose than the cage was bound in: either may be the rest of the
// weights. As bound, it is in the coordinates of the root, which is no joint.
TEST(GltfSkeleton, ModelsRestInThePoseOfTheFileOrAsItWasBound) {
  const RiggedRing example;
  const auto& cage = example.sample.cage.points;
  const PointList<3> under_root = Rig::root().inverse() * cage;
  const auto bind = products(inverses(Rig::places(1)), Frames(3, Rig::root()));
  const auto as_bound = example.skin(example.rig(bind, under_root), true);
  for (int key = 0; key < 3; ++key) {
    const auto pose = example.skinned(example.bones, products(Rig::places(key), bind), under_root);
    EXPECT_LT(apart(seen(as_bound.content, key), deform<3>(example.weights, pose)), kSingle);
  }
  EXPECT_LT(apart(seen(as_bound.content, 1), example.sample.mesh.points), kSingle);

  // Vertices of the file that the nodes put at the control points.
  const auto moves = products(Rig::places(-1), bind);
  auto bound = cage;
  for (Index i = 0; i < cage.cols(); ++i) {
    Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
    for (int j = 0; j < 3; ++j) sum += example.bones(j, i) * moves[j].matrix();
    bound.col(i) = Eigen::Affine3d(sum).inverse() * Vector<3>(cage.col(i));
  }
  const auto as_posed = example.skin(example.rig(bind, bound), true);
  EXPECT_LT(apart(seen(as_posed.content, -1), example.sample.mesh.points), kSingle);
  for (int key = 0; key < 3; ++key) {
    const auto pose = example.skinned(example.bones, products(Rig::places(key), bind), bound);
    EXPECT_LT(apart(seen(as_posed.content, key), deform<3>(example.weights, pose)), 10 * kSingle);
  }
}

TEST(GltfSkeleton, PointsWithoutWeightsStay) {
  RiggedRing example;
  example.weights.col(3).setZero();
  example.binding = bound_by<3>(example.sample.cage, example.sample.mesh.points, example.weights);
  const auto skin =
      example.skin(example.rig(inverses(Rig::places(-1)), example.sample.cage.points), true);
  for (int key = -1; key < 3; ++key) {
    EXPECT_LT((seen(skin.content, key).col(3) - example.sample.mesh.points.col(3)).norm(), kSingle);
  }
}

TEST(GltfSkeleton, OthersAreRefused) {
  const RiggedRing example;
  const auto bind = inverses(Rig::places(-1));
  auto other = example.sample.cage.points;
  other.col(2) += Vector<3>(0, 0.25, 0);
  expect_refused("number 2 at (", [&] { example.skin(example.rig(bind, other)); });
  auto near = example.sample.cage.points;
  near.col(2) += Vector<3>(0, 1e-5, 0);
  const auto still = example.skin(example.rig(bind, near, ""));
  EXPECT_EQ(still.keys, 0U);
  EXPECT_FALSE(GlbFile(still.content).json.contains("animations"));
  expect_refused("splines", [&] { example.skin(example.rig(bind, near, "CUBICSPLINE")); });
  NewGlb file(R"({"nodes":[{"mesh":0}],"meshes":[{"primitives":[{}]}]})");
  file.primitive(0)["attributes"]["POSITION"] =
      file.add<float>(Eigen::MatrixXd(example.sample.cage.points.leftCols(3)));
  expect_refused("no mesh has a skin", [&] { example.skin(file.glb()); });
  gltf::SkinOptions usd;
  usd.format = gltf::SkinFormat::kUsda;
  EXPECT_THROW(gltf::export_skin(example.binding, example.surface, usd, gltf::Skeleton(), false),
               OptionError);
}

}  // namespace
}  // namespace flbc::testing::rigged
