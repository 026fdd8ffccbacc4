// SPDX-License-Identifier: BSD-3-Clause
#include "gltf/skin.h"

#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "flbc/bounding_box.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "flbc/io/mesh_io.h"
#include "flbc/poses.h"
#include "flbc/rig.h"
#include "flbc/sparsify.h"
#include "support/dimensions.h"
#include "support/glb_file.h"
#include "support/harmonic_weights.h"
#include "support/refined_sample.h"
#include "support/usda_file.h"

namespace flbc::testing {
namespace {

// A mesh of a cage's interior, and triangles between all its vertices: on the boundary few control
// points would matter.
template <int Dim>
struct Example {
  explicit Example(Sample<Dim> given = make_sample<Dim>(Shape::kRing, 3))
      : sample(std::move(given)),
        weights(harmonic_weights(sample)),
        edges(edges_of_cells(sample.mesh)) {
    const auto& mesh = sample.mesh;
    for (Index v = 0; v < mesh.num_vertices(); ++v) surface.sources.push_back(v);
    surface.triangles = mesh.cells.template topRows<3>();
    surface.normals = Vector<3>(0.6, 0, 0.8).replicate(1, mesh.num_vertices());
  }
  gltf::ExportedSkin skin(const gltf::SkinOptions& options = {},
                          const gltf::Animation<Dim>& animation = {}) const {
    return gltf::export_skin<Dim>(bound_by<Dim>(sample.cage, sample.mesh.points, weights, edges),
                                  surface, options, animation);
  }
  SparseWeights few(Index count, const std::vector<PointList<Dim>>& poses = {}) const {
    return reduce_influences<Dim>(sample.cage.points, sample.mesh.points, edges,
                                  SparseWeights(weights), poses, {count});
  }

  Sample<Dim> sample;
  WeightMatrix weights;
  EdgeList edges;
  gltf::Surface surface;
};

// As skins have them, in space.
template <int Dim>
Eigen::MatrixXd in_space(const PointList<Dim>& points) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3, points.cols());
  result.topRows(Dim) = points;
  return result;
}

// The largest distance between the skin's vertices and the points they are copies of.
template <int Dim>
double distance(const GlbFile& file, const Eigen::MatrixXd& joints, const PointList<Dim>& points) {
  const Eigen::MatrixXd expected = in_space<Dim>(points)(Eigen::all, file.sources());
  return (file.skinned(joints) - expected).colwise().norm().maxCoeff();
}

// The demands of the specification on influences.
void expect_sound_influences(const GlbFile& file) {
  const Eigen::MatrixXd joints = file.influences("JOINTS_");
  const Eigen::MatrixXd numbers = file.influences("WEIGHTS_", true);
  ASSERT_EQ(joints.rows(), numbers.rows());
  for (Eigen::Index v = 0; v < joints.cols(); ++v) {
    std::set<double> used;
    for (Eigen::Index slot = 0; slot < joints.rows(); ++slot) {
      if (numbers(slot, v) == 0) {
        EXPECT_EQ(joints(slot, v), 0);
        continue;
      }
      EXPECT_GT(numbers(slot, v), 0);
      EXPECT_TRUE(used.insert(joints(slot, v)).second) << "joint twice at vertex " << v;
      // The largest first, up to rounding.
      if (slot == 0) continue;
      EXPECT_LE(numbers(slot, v), numbers(slot - 1, v) + 1e-6);
    }
    EXPECT_NEAR(numbers.col(v).sum(), 1, std::ldexp(1, -25));
  }
}

TEST_IN_2D_AND_3D(GltfSkinTest, MovesAsDeformDoes) {
  const Example<Dim> example;
  const auto& cage = example.sample.cage.points;
  const auto poses = independent_poses<Dim>(cage, 3);
  for (const Index count : {4, 8}) {
    gltf::SkinOptions options;
    options.max_influences = count;
    const auto skin = example.skin(options);
    const GlbFile file(skin.content);
    EXPECT_EQ(skin.influences, count);
    EXPECT_EQ(skin.given_influences, example.sample.cage.size());
    EXPECT_EQ(file.has("JOINTS_1"), count == 8);
    EXPECT_FALSE(file.has("JOINTS_2"));
    expect_sound_influences(file);
    EXPECT_LT(distance<Dim>(file, in_space<Dim>(cage), example.sample.mesh.points), 1e-6);
    for (const auto& pose : poses) {
      const auto expected = deform<Dim>(example.few(count), pose);
      EXPECT_GT((expected - example.sample.mesh.points).norm(), 0.1);
      EXPECT_LT(distance<Dim>(file, in_space<Dim>(pose), expected), 1e-6);
    }
  }
}

TEST_IN_2D_AND_3D(GltfSkinTest, AnimationsAreLinearBetweenPoses) {
  const Example<Dim> example;
  const auto& cage = example.sample.cage.points;
  gltf::Animation<Dim> animation{{0, 0.5, 2}, {cage, cage, cage}};
  animation.poses[1].col(2) += Vector<Dim>::Constant(0.25);
  animation.poses[2].col(3) -= Vector<Dim>::Constant(0.5);
  const auto skin = example.skin({}, animation);
  EXPECT_EQ(skin.moving_joints, 2);
  const GlbFile file(skin.content);
  ASSERT_EQ(file.json["animations"].size(), 1);
  EXPECT_EQ(file.json["animations"][0]["channels"].size(), 2);
  const auto few = example.few(8, animation.poses);
  const auto expect_pose = [&](double time, const PointList<Dim>& pose) {
    EXPECT_LT(distance<Dim>(file, file.joints(time), deform<Dim>(few, pose)), 1e-6);
  };
  for (int k = 0; k < 3; ++k) expect_pose(animation.times[k], animation.poses[k]);
  expect_pose(0.25, (animation.poses[0] + animation.poses[1]) / 2);
  expect_pose(1.625, (animation.poses[1] + 3 * animation.poses[2]) / 4);

  // Nothing moves: that is no animation.
  const GlbFile still(example.skin({}, {{0}, {cage}}).content);
  EXPECT_FALSE(still.json.contains("animations"));
}

TEST_IN_2D_AND_3D(GltfSkinTest, NodesAndBindMatrices) {
  const Example<Dim> example;
  gltf::SkinOptions options;
  options.name = "caf\xc3\xa9";
  const GlbFile file(example.skin(options).content);
  const auto& nodes = file.json["nodes"];
  const auto& skin = file.json["skins"][0];
  const auto n = example.sample.cage.size();
  ASSERT_EQ(skin["joints"].size(), n + 2);
  // The control points have one parent, which is a joint and a root of the scene, as is the mesh.
  const auto& parent = file.root_joint();
  ASSERT_EQ(parent["children"].size(), n + 1);
  EXPECT_EQ(skin["joints"][n], skin["skeleton"]);
  EXPECT_EQ(skin["joints"][n + 1], parent["children"][n]);
  EXPECT_EQ(file.json["scenes"][0]["nodes"].size(), 2);
  EXPECT_EQ(file.json["scenes"][0]["nodes"][1], skin["skeleton"]);
  const auto& mesh = nodes[file.json["scenes"][0]["nodes"][0].get<std::size_t>()];
  EXPECT_EQ(mesh["mesh"], 0);
  EXPECT_EQ(mesh["skin"], 0);
  EXPECT_EQ(mesh["name"], "caf\xc3\xa9");
  const Eigen::MatrixXd binds = file.accessor(skin["inverseBindMatrices"]);
  ASSERT_EQ(binds.cols(), n + 2);
  const Eigen::MatrixXd joints = file.joints();
  for (Index i = 0; i < n; ++i) {
    EXPECT_EQ(skin["joints"][i], parent["children"][i]);
    const auto& joint = nodes[skin["joints"][i].template get<std::size_t>()];
    EXPECT_EQ(joint["name"], "control_point_" + std::to_string(i));
    EXPECT_LT((joints.col(i) - in_space<Dim>(example.sample.cage.points).col(i)).norm(), 1e-6);
    // The inverse but for rounding, so that nothing moves at rest.
    Eigen::Matrix4d expected = Eigen::Matrix4d::Identity();
    expected.col(3).head<3>() = -joints.col(i);
    EXPECT_LT((binds.col(i).reshaped(4, 4) - expected).norm(), 1e-6);
  }
  // Bones are short: none is nearer to the root than the joint that moves nothing.
  const auto& helper = nodes[skin["joints"][n + 1].template get<std::size_t>()]["translation"];
  const double length =
      Eigen::Vector3d(helper[0].template get<double>(), helper[1].template get<double>(),
                      helper[2].template get<double>())
          .norm();
  EXPECT_NEAR(length, 0.02 * bounding_box_diagonal<Dim>(example.sample.cage.points), 1e-6);
  EXPECT_TRUE(file.json["accessors"][file.number_of("POSITION")].contains("min"));

  options.name = "caf\xe9";  // Latin-1: a name, but no UTF-8
  EXPECT_EQ(GlbFile(example.skin(options).content).json["meshes"][0]["name"], "caf\xef\xbf\xbd");
}

// Read as the schema UsdSkel says, by a reader that takes no liberties.
TEST_IN_2D_AND_3D(GltfSkinTest, UsdSkinsMoveAsDeformDoes) {
  Example<Dim> example;
  const auto& cage = example.sample.cage.points;
  const auto count = static_cast<Eigen::Index>(example.surface.sources.size());
  example.surface.texture_coordinates = Eigen::MatrixXd::Random(2, count);
  example.surface.colors = Eigen::MatrixXd::Random(3, count).cwiseAbs();
  const auto pose = independent_poses<Dim>(cage, 1)[0];
  gltf::SkinOptions options;
  options.format = gltf::SkinFormat::kUsda;
  const UsdaFile still(example.skin(options).content);
  const Eigen::MatrixXd rest = in_space<Dim>(example.sample.mesh.points);
  EXPECT_LT((still.skinned() - rest).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_FALSE(still.has("/model/poses.translations"));

  const UsdaFile file(example.skin(options, {{0, 1}, {cage, pose}}).content);
  EXPECT_EQ(file.metadata().at("defaultPrim").words[0], "model");
  EXPECT_EQ(file.type_of("/model"), "SkelRoot");
  EXPECT_EQ(file.type_of("/model/poses"), "SkelAnimation");
  EXPECT_EQ(file.metadata().at("endTimeCode").numbers[0], 24);
  const double begin = 0, end = 24;
  EXPECT_LT((file.skinned(&begin) - rest).cwiseAbs().maxCoeff(), 1e-5);
  const Eigen::MatrixXd expected = in_space<Dim>(deform<Dim>(example.few(8, {cage, pose}), pose));
  EXPECT_GT((expected - rest).norm(), 0.1);
  EXPECT_LT((file.skinned(&end) - expected).cwiseAbs().maxCoeff(), 1e-5);
  const auto& joints = file["/model/cage.joints"].value.words;
  ASSERT_EQ(joints.size(), static_cast<std::size_t>(cage.cols()) + 1);
  EXPECT_EQ(joints[0], "cage");
  EXPECT_EQ(joints[1], "cage/control_point_0");

  const std::string surface = "/model/surface.";
  for (const char* name : {"points", "normals", "primvars:st", "primvars:displayColor"}) {
    EXPECT_EQ(file[surface + name].value.count, static_cast<std::size_t>(count)) << name;
  }
  for (const double corner : file[surface + "faceVertexIndices"].value.numbers) {
    EXPECT_LT(corner, count);
  }
  EXPECT_NEAR(file[surface + "primvars:st"].value.numbers[1],
              1 - example.surface.texture_coordinates(1, 0), 1e-6);
}

TEST_IN_2D_AND_3D(GltfSkinTest, SurfaceAndItsAttributes) {
  Example<Dim> example;
  auto& surface = example.surface;
  const GlbFile plain(example.skin().content);
  for (const char* name : {"TEXCOORD_0", "COLOR_0", "_VERTEX"}) EXPECT_FALSE(plain.has(name));
  const auto count = static_cast<Eigen::Index>(surface.sources.size());
  surface.texture_coordinates = Eigen::MatrixXd::Random(2, count);
  surface.colors = Eigen::MatrixXd::Random(3, count).cwiseAbs();
  // One more copy of the last vertex.
  surface.sources.push_back(surface.sources.back());
  const auto append = [&](auto& columns) {
    columns.conservativeResize(Eigen::NoChange, count + 1);
    columns.col(count) = columns.col(count - 1);
  };
  append(surface.normals);
  append(surface.texture_coordinates);
  append(surface.colors);
  surface.triangles(0, 0) = static_cast<Index>(count);
  const GlbFile file(example.skin().content);
  EXPECT_EQ(file.triangles(), surface.triangles.template cast<double>());
  EXPECT_TRUE(file.has("_VERTEX"));
  EXPECT_EQ(file.sources(),
            std::vector<Eigen::Index>(surface.sources.begin(), surface.sources.end()));
  EXPECT_EQ(file.attribute("NORMAL"),
            surface.normals.template cast<float>().template cast<double>());
  EXPECT_EQ(file.attribute("TEXCOORD_0"),
            surface.texture_coordinates.template cast<float>().template cast<double>());
  EXPECT_EQ(file.attribute("COLOR_0"),
            surface.colors.template cast<float>().template cast<double>());
  EXPECT_LT(
      distance<Dim>(file, in_space<Dim>(example.sample.cage.points), example.sample.mesh.points),
      1e-6);
}

// Points on segments between control points, so that two of these matter to each.
template <int Dim>
struct Segments {
  explicit Segments(Index n) : control_points(PointList<Dim>::Random(Dim, n)) {
    weights.setZero(n, 3);
    weights(0, 0) = weights(n - 1, 1) = 1;
    weights(n - 1, 2) = 0.25;
    weights(n - 2, 2) = 0.75;
    points = control_points * weights;
    surface.sources = {0, 1, 2};
    surface.triangles.resize(3, 1);
    surface.triangles << 0, 1, 2;
    surface.normals = Vector<3>::UnitZ().replicate(1, 3);
  }
  GlbFile skin() const {
    const auto binding = bound_by<Dim>({control_points, {}}, points, weights);
    return GlbFile(gltf::export_skin<Dim>(binding, surface).content);
  }

  PointList<Dim> control_points;
  PointList<Dim> points;
  WeightMatrix weights;
  gltf::Surface surface;
};

TEST_IN_2D_AND_3D(GltfSkinTest, JointsTakeTwoBytesWhereOneIsTooFew) {
  const auto check = [](Index n, int component_type) {
    const Segments<Dim> segments(n);
    const auto file = segments.skin();
    EXPECT_EQ(file.json["accessors"][file.number_of("JOINTS_0")]["componentType"], component_type);
    EXPECT_FALSE(file.has("JOINTS_1"));
    const Eigen::MatrixXd joints = file.attribute("JOINTS_0");
    EXPECT_EQ(joints(0, 1), n - 1);
    EXPECT_EQ(joints.col(2).head(2), Eigen::Vector2d(n - 2, n - 1));
    EXPECT_EQ(file.attribute("WEIGHTS_0").col(2), Eigen::Vector4d(0.75, 0.25, 0, 0));
  };
  check(256, 5121);
  check(257, 5123);
  check(65535, 5123);
  expect_error<InputError>([] { Segments<Dim>(65536).skin(); }, {"65536 control points", "65535"});
}

TEST(GltfSkin, IndicesTakeFourBytesWhereTwoAreTooFew) {
  const auto check = [](Index columns, int component_type) {
    // Two rows of points in a triangle, with their barycentric coordinates.
    PointList<2> control_points(2, 3);
    control_points << 0, 4, 0,  //
        0, 0, 4;
    PointList<2> points(2, 2 * columns);
    WeightMatrix weights(3, 2 * columns);
    for (Index v = 0; v < 2 * columns; ++v) {
      points.col(v) << 1 + static_cast<double>(v / 2) / columns, 1 + v % 2;
      weights.col(v) << 1 - points.col(v).sum() / 4, points(0, v) / 4, points(1, v) / 4;
    }
    // An odd number of triangles, so that what follows their numbers has to be aligned.
    DomainMesh<2> strip{points, CellList<2>(3, 2 * columns - 3)};
    for (Index t = 0; t < 2 * columns - 3; ++t) strip.cells.col(t) << t, t + 1, t + 2;
    const auto surface = gltf::surface_of_model<2>({io::to_polygons(strip)});
    const auto binding = bound_by<2>({control_points, {}}, points, weights);
    const GlbFile file(gltf::export_skin<2>(binding, surface).content);
    EXPECT_EQ(
        file.json["accessors"][file.primitive()["indices"].get<std::size_t>()]["componentType"],
        component_type);
    EXPECT_EQ(file.triangles(), surface.triangles.cast<double>());
  };
  check(3, 5123);
  check(32768, 5123);
  check(32769, 5125);
}

// The nearest rotation R between centered points X and Y has symmetric R X Y^T with eigenvalues
// whose sums of pairs are not negative; its error is part of the report.
TEST_IN_2D_AND_3D(GltfSkinTest, SolidRegionsMayBeRigid) {
  const Example<Dim> example(with_fine_cage<Dim>(Shape::kBox, Dim == 2 ? 8 : 4, 8));
  const auto& rest = example.sample.mesh.points;
  BindOptions bind_options;
  bind_options.max_influences = 0;
  bind_options.solid.emplace_back();
  auto& region = bind_options.solid[0];
  for (Index p = 0; p < rest.cols(); ++p) {
    if ((rest.col(p) - Vector<Dim>::Constant(0.4)).norm() < 0.17) region.push_back(p);
  }
  ASSERT_GE(region.size(), 6U);
  ASSERT_LT(region.size(), static_cast<std::size_t>(rest.cols()) / 2);
  Rig<Dim> rig(example.sample.cage, example.sample.mesh, rest, example.edges, bind_options);
  const auto binding = rig.binding();

  const auto& cage = example.sample.cage.points;
  gltf::Animation<Dim> animation{{0, 1, 2}, independent_poses<Dim>(cage, 2)};
  animation.poses.insert(animation.poses.begin(), cage);
  for (const auto format : {gltf::SkinFormat::kGlb, gltf::SkinFormat::kUsda}) {
    gltf::SkinOptions options;
    options.format = format;
    const auto affine = gltf::export_skin(binding, example.surface, options, animation);
    EXPECT_FALSE(affine.rigid_error);
    options.rigid = true;
    const auto skin = gltf::export_skin(binding, example.surface, options, animation);
    EXPECT_EQ(skin.joints, affine.joints + 1);
    EXPECT_EQ(skin.moving_joints, affine.moving_joints + 1);
    const auto seen = [&](const std::string& content, int k) -> Eigen::MatrixXd {
      const double time = 24.0 * k;
      if (format == gltf::SkinFormat::kUsda) return UsdaFile(content).skinned(&time);
      const GlbFile file(content);
      return file.skinned(file.joints(k), file.turns(k));
    };
    const Eigen::MatrixXd x = in_space<Dim>(rest)(Eigen::all, region);
    const Eigen::MatrixXd centered = x.colwise() - x.rowwise().mean();
    std::vector<Index> others;
    for (Index p = 0; p < rest.cols(); ++p) {
      if (std::find(region.begin(), region.end(), p) == region.end()) others.push_back(p);
    }
    double squares = 0, most = 0;
    for (int k = 0; k < 3; ++k) {
      const Eigen::MatrixXd all = seen(skin.content, k), without = seen(affine.content, k);
      EXPECT_LT((all - without)(Eigen::all, others).cwiseAbs().maxCoeff(), 1e-5);
      const Eigen::MatrixXd moved = all(Eigen::all, region);
      const Eigen::MatrixXd turned = moved.colwise() - moved.rowwise().mean();
      EXPECT_LT((turned.transpose() * turned - centered.transpose() * centered).norm(), 1e-4);
      const Eigen::MatrixXd y =
          in_space<Dim>(binding.deform(animation.poses[k]))(Eigen::all, region);
      EXPECT_LT((moved.rowwise().mean() - y.rowwise().mean()).norm(), 1e-5);
      const Eigen::Matrix<double, Dim, Dim> product =
          (turned * y.transpose()).topLeftCorner(Dim, Dim);
      EXPECT_LT((product - product.transpose()).norm(), 1e-4 * product.norm());
      const Eigen::Matrix<double, Dim, Dim> symmetric = (product + product.transpose()) / 2;
      const auto values =
          Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Dim, Dim>>(symmetric).eigenvalues();
      EXPECT_GE(values[0] + values[1], -1e-4 * product.norm());
      const auto lengths = (moved - y).colwise().norm().eval();
      squares += lengths.squaredNorm() / static_cast<double>(3 * lengths.size());
      most = std::max(most, lengths.maxCoeff());
      EXPECT_LT(k == 0 ? (moved - x).norm() : 0, 1e-6);
    }
    EXPECT_GT(most, 0.01) << "every affine map was rigid";
    EXPECT_NEAR(skin.rigid_error->max, most, 1e-5);
    EXPECT_NEAR(skin.rigid_error->rms, std::sqrt(squares), 1e-5);
  }
}

TEST_IN_2D_AND_3D(GltfSkinTest, SinglePrecisionIsMeasured) {
  Example<Dim> example;
  EXPECT_LT(example.skin().position_change, 1e-6);
  // Floats near 2^20 are 1/16 to 1/8 apart.
  example.sample.cage.points.array() += 1048576;
  example.sample.mesh.points.array() += 1048576;
  gltf::SkinOptions usd;
  usd.format = gltf::SkinFormat::kUsda;
  const double change = example.skin(usd).position_change;
  EXPECT_GT(change, 0.01);
  EXPECT_LT(change, 0.0625 * std::sqrt(Dim));
  // In glTF the root joint says where the model is.
  const auto& cage = example.sample.cage.points;
  const auto pose = independent_poses<Dim>(cage, 1)[0];
  const auto skin = example.skin({}, {{0.0}, {pose}});
  EXPECT_LT(skin.position_change, 1e-6);
  const GlbFile file(skin.content);
  // Seen from there: far away the sums of the weights, which are floats, would count.
  const Vector<Dim> root = file.root().translation().head<Dim>();
  const PointList<Dim> near_cage = cage.colwise() - root;
  const PointList<Dim> near_points = example.sample.mesh.points.colwise() - root;
  EXPECT_LT(distance<Dim>(file, in_space<Dim>(near_cage), near_points), 1e-6);
  EXPECT_LT((file.joints() - in_space<Dim>(cage)).norm(), 1e-5);
  EXPECT_LT((file.joints(0) - in_space<Dim>(pose)).norm(), 1e-5);
  // A turned model turns about the origin, however far that is.
  gltf::SkinOptions turned;
  turned.turn << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const GlbFile upright(example.skin(turned, {{0.0}, {pose}}).content);
  EXPECT_LT((upright.joints() - turned.turn * in_space<Dim>(cage)).norm(), 1e-5);
  EXPECT_LT((upright.joints(0) - turned.turn * in_space<Dim>(pose)).norm(), 1e-5);

  Segments<Dim> segments(5);
  segments.control_points *= 1e39;
  segments.points *= 1e39;
  expect_error<InputError>([&] { segments.skin(); }, {"too large for single precision"});
}

TEST_IN_2D_AND_3D(GltfSkinTest, ErrorsOfStoringAreMeasured) {
  Example<Dim> example;
  const auto pose = independent_poses<Dim>(example.sample.cage.points, 1)[0];
  gltf::SkinOptions options;
  options.max_influences = 4;
  // Copies of a point count once.
  auto& surface = example.surface;
  surface.sources.insert(surface.sources.end(), 1000, surface.sources.back());
  surface.normals = Vector<3>(0, 0, 1).replicate(1, static_cast<int>(surface.sources.size()));
  const auto skin = example.skin(options, {{0}, {pose}});
  const auto errors = displacements<Dim>(deform<Dim>(example.weights, pose),
                                         deform<Dim>(example.few(4, {pose}), pose));
  EXPECT_GT(errors.maxCoeff(), 0.01);
  EXPECT_NEAR(skin.deformation_error.max, errors.maxCoeff(), 1e-6);
  EXPECT_NEAR(skin.deformation_error.rms,
              std::sqrt(errors.squaredNorm() / static_cast<double>(errors.size())), 1e-6);
}

TEST_IN_2D_AND_3D(GltfSkinTest, WhatDoesNotFitIsRefused) {
  const Example<Dim> example;
  const auto expect_refusal = [&](auto change, const std::string& message) {
    Example<Dim> changed = example;
    change(changed);
    expect_error<InputError>([&] { changed.skin(); }, {message});
  };
  for (const Index count : {-1, 0, 3, 5, 12}) {
    gltf::SkinOptions options;
    options.max_influences = count;
    expect_error<OptionError>([&] { example.skin(options); }, {"4 or 8"});
  }
  const auto drop = [](auto& matrix) {
    matrix.conservativeResize(Eigen::NoChange, matrix.cols() - 1);
  };
  expect_refusal([&](auto& e) { drop(e.sample.cage.points); }, "control points do not match");
  expect_refusal([&](auto& e) { drop(e.sample.mesh.points); }, "points and");
  expect_refusal([&](auto& e) { drop(e.surface.normals); }, "normals of vertices");
  expect_refusal([&](auto& e) { e.surface.triangles(0, 0) = 100000; }, "surface of the skin");
  expect_refusal([&](auto& e) { e.surface.triangles(0, 0) = -1; }, "surface of the skin");
  expect_refusal([&](auto& e) { e.surface.sources[0] = 100000; }, "surface of the skin");
  expect_refusal([&](auto& e) { e.surface.triangles.resize(3, 0); }, "surface of the skin");

  // A point that the weights do not reproduce keeps its offset.
  auto apart = example;
  apart.sample.mesh.points.col(0).setConstant(50);
  EXPECT_NO_THROW(apart.skin());

  const auto& cage = example.sample.cage.points;
  const auto expect_refused_times = [&](const std::vector<double>& times,
                                        const std::string& message) {
    const gltf::Animation<Dim> animation{times, {cage, cage}};
    expect_error<InputError>([&] { example.skin({}, animation); }, {message});
  };
  expect_refused_times({0}, "times of poses");
  expect_refused_times({-1, 0}, "pose 0 is at -1 s");
  expect_refused_times({0, 0}, "pose 1 is at 0 s, not later");
  expect_refused_times({1, 1 + 1e-12}, "pose 1 is at 1 s, not later");
  expect_refused_times({0, std::numeric_limits<double>::quiet_NaN()}, "pose 1 is at nan s");
  expect_refused_times({0, 1e39}, "pose 1 is at 1e+39 s");
  const gltf::Animation<Dim> other{{0}, {cage.leftCols(3)}};
  expect_error<InputError>([&] { example.skin({}, other); }, {"poses of control points"});
  const gltf::Animation<Dim> far{{0}, {cage * 1e39}};
  expect_error<InputError>([&] { example.skin({}, far); },
                           {"of the cage in pose 0 has a coordinate that is too large"});
}

}  // namespace
}  // namespace flbc::testing
