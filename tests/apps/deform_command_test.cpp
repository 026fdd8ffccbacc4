// SPDX-License-Identifier: BSD-3-Clause
// flbc deform as its users and their scripts see it.
#include "flbc/deform.h"
#include "support/command_line.h"
#include "support/vtu_fields.h"

namespace flbc::testing {
namespace {

class DeformCommand : public CommandLineTest {
 protected:
  Ended expect_deform(const std::string& arguments, int status = 0,
                      const std::string& words = "") const {
    return expect("deform " + arguments, status, words);
  }
};

TEST_F(DeformCommand, NormalsOfAnAffineImageAreTheImagesOfNormals) {
  ASSERT_NO_FATAL_FAILURE(solve("3d/limb", "d.mesh"));
  auto model = io::ModelFile("3d/limb_model.obj").model();
  auto& attributes = model.attributes;
  const auto num_vertices = static_cast<Index>(model.soup.points.size());
  attributes = {};
  attributes.normals = PointList<3>::Random(3, num_vertices);
  for (const auto& polygon : model.soup.polygons) {
    auto& corners = attributes.corners.emplace_back();
    for (const Index vertex : polygon) corners.push_back({-1, vertex});
  }
  io::write_model("model.obj", model);
  Eigen::Matrix3d a;
  a << 2, -1, 0, 1, 0.5, 0, 0, 0.25, 3;
  moved("3d/limb_cage.obj", "affine.obj", [&](const auto& point) { return a * point; });

  const std::string command =
      "model.obj --weights v.npy --pose affine.obj --normals jacobian -q -o o.obj";
  expect_deform(command, 1, "--normals jacobian needs a binding");
  expect_deform(command + " --domain d.mesh", 1, "--domain: --rest is missing");
  expect_deform(command + " --rest 3d/limb_cage.obj --domain d.mesh");
  const io::ModelFile result("o.obj");
  const auto& normals = result.model().attributes.normals;
  ASSERT_EQ(normals.cols(), num_vertices);
  const Eigen::Matrix3d inverse = a.inverse().transpose();
  for (Index v = 0; v < num_vertices; ++v) {
    const Vector<3> before = attributes.normals.col(v);
    const Vector<3> expected = before.norm() * (inverse * before).normalized();
    EXPECT_LT((normals.col(v) - expected).norm(), 1e-9);
  }
  const auto rest = points_in<3>("model.obj");
  EXPECT_LT((points_in<3>("o.obj") - a * rest).cwiseAbs().maxCoeff(), 1e-9);

  // What solve writes gives the same Jacobians.
  expect(
      "solve 3d/limb_cage.obj --method harmonic -q -o m.npy --domain d.mesh --model model.obj "
      "--gradients g.npy "
      "--save-domain d.vtu");
  const auto gradients = io::read_weights("g.npy").dense();
  ASSERT_EQ(gradients.cols(), num_vertices);
  const auto pose = points_in<3>("affine.obj");
  for (Index v = 0; v < num_vertices; ++v) {
    const Eigen::Matrix3d jacobian = pose * gradients.col(v).reshaped(3, pose.cols()).transpose();
    EXPECT_LT((jacobian - a).norm(), 1e-9);
  }
  const auto fields = fields_in_vtu(slurp("d.vtu"));
  EXPECT_EQ(fields.size(), 4 * static_cast<std::size_t>(pose.cols()));
  EXPECT_EQ(fields.back().name, "dw_" + std::to_string(pose.cols() - 1) + "_dz");
}

const char* const kModel =
    "# made by hand\r\n"
    "mtllib a.mtl\n"
    "v 0.25 0.25 0.5 1 0 0 # red\n"
    "\tv  0.5\t0.25 0.5\n"
    "v 0.5 0.5 \\\n 0.5\n"
    "v 0.25 0.5 0.5 0.5 0.5 0.5\r\n"
    "vt 0.125 0.5\n"
    "vn 0 0 -2\n"
    "g top\nusemtl red\ns off\n"
    "f 1/1/-1 2/1/1 3/1/1 4/1/1\n"
    "l 1 3\n"
    "# no line break at the end";

// As kModel.
PointList<3> model_points() {
  PointList<3> points(3, 4);
  points << 0.25, 0.5, 0.5, 0.25,  //
      0.25, 0.25, 0.5, 0.5,        //
      0.5, 0.5, 0.5, 0.5;
  return points;
}

TEST_F(DeformCommand, NothingButCoordinatesAndNormalsChangesInObj) {
  const auto model = file("model.obj", kModel);
  const auto command =
      model + " --weights " + linear_weights(model_points()) + " -o o.obj -q --pose ";
  // Turned about the x axis by a right angle, and moved by 2 along it: y becomes z, z becomes -y.
  expect_deform(command + tetrahedron("v 2 0 0\nv 3 0 0\nv 2 0 1\nv 2 -1 0\n"));
  std::string expected = kModel;
  const auto replace = [&](const std::string& before, const std::string& after) {
    ASSERT_NE(expected.find(before), std::string::npos);
    expected.replace(expected.find(before), before.size(), after);
  };
  replace("0.25 0.25 0.5 1", "2.25 -0.5 0.25 1");
  replace("0.5\t0.25 0.5\n", "2.5\t-0.5 0.25\n");
  replace("0.5 0.5 \\\n 0.5", "2.5 -0.5 \\\n 0.5");
  replace("0.25 0.5 0.5 0.5 0.5 0.5", "2.25 -0.5 0.5 0.5 0.5 0.5");
  const auto result = slurp("o.obj");
  // The normal was on the other side of the face than its corners say, and stays there.
  std::istringstream at_normal(result.substr(result.find("vn ") + 3));
  Vector<3> found;
  at_normal >> found[0] >> found[1] >> found[2];
  EXPECT_LT((found - Vector<3>(0, 2, 0)).norm(), 1e-14) << result;
  const auto end = result.find("\ng top");
  ASSERT_NE(end, std::string::npos);
  replace("vn 0 0 -2", result.substr(result.find("vn "), end - result.find("vn ")));
  EXPECT_EQ(result, expected);
}

TEST_F(DeformCommand, LinesThatContinueOthers) {
  const auto command = " --weights " + linear_weights(model_points().leftCols(1)) + " --pose " +
                       tetrahedron("v 1 0 0\nv 2 0 0\nv 1 1 0\nv 1 0 1\n") + " -q -o o.obj";
  expect_deform(file("model.obj", "v 0.25 0.25 0.5 1 0 \\\n0\n# v 1 2 3 \\\n") + command);
  EXPECT_EQ(slurp("o.obj"), "v 1.25 0.25 0.5 1 0 \\\n0\n# v 1 2 3 \\\n");
}

TEST_F(DeformCommand, NormalsWithoutFacesAreToldAndStay) {
  const auto model = file("model.obj", std::string(kModel) + "\nvn 1 2 3\n");
  expect_deform(model + " --weights " + linear_weights(model_points()) + " --pose " +
                    tetrahedron("v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\n") + " -o o.obj",
                0, "1 normals belong to no face");
  expect_piece(slurp("o.obj"), "\nvn 1 2 3\n");
  expect_piece(slurp("o.obj"), "v 0.5 0.5 1 1 0 0 # red");
}

TEST_F(DeformCommand, Sequences) {
  const auto rest = tetrahedron();
  for (const std::string x : {"1", "2", "3"}) {
    moved(rest, "pose_0" + x + ".obj",
          [&](const Vector<3>& point) { return point + std::stoi(x) * Vector<3>::UnitX(); });
  }
  const auto model = file("model.obj", kModel);
  const auto command = model + " --weights " + linear_weights(model_points()) + " -o ";
  const std::string pattern = " --pose pose_%02d.obj";
  expect_deform(command + "o_%d.obj" + pattern + " --rest " + rest + " --displacement d.npy", 0,
                "4 vertices, 3 poses");
  for (int k = 1; k <= 3; ++k) {
    const auto output = "o_" + std::to_string(k) + ".obj";
    PointList<3> expected = model_points();
    expected.row(0).array() += k;
    EXPECT_EQ(points_in<3>(output), expected);
  }
  const auto lengths = io::read_weights("d.npy").dense();
  ASSERT_EQ(lengths.rows(), 3);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(lengths.row(k).sum(), 4 * (k + 1));

  expect_deform(command + "s%03d.obj -q --pose pose_03.obj --pose pose_01.obj");
  EXPECT_EQ(points_in<3>("s000.obj")(0, 0), 3.25);
  EXPECT_EQ(points_in<3>("s001.obj")(0, 0), 1.25);

  expect_deform(command + "o.obj" + pattern, 1, "there are 3 poses");
  expect_deform(command + "o%d_%d.obj" + pattern, 1, "one %d");
  expect_deform(command + "o_%d.obj --pose absent_%d.obj", 4, "absent_0.obj");
  expect_deform(command + "pose_%02d.obj" + pattern, 1, "would replace this input file");
}

// They are finite, although their squares are not. Of a sequence that fails nothing is left.
TEST_F(DeformCommand, EnormousDisplacements) {
  const auto model = file("model.obj", kModel);
  const auto rest = tetrahedron();
  const auto away = tetrahedron("v 1e200 0 0\nv 1e200 0 0\nv 1e200 1 0\nv 1e200 0 1\n", "away.obj");
  expect_deform(model + " --weights " + linear_weights(model_points()) + " --rest " + rest +
                    " --displacement d.npy --pose " + rest + " " + away + " -o o_%d.obj",
                0, "largest displacement 1e+200");
  EXPECT_NEAR(io::read_weights("d.npy").dense().maxCoeff(), 1e200, 1e186);
  std::filesystem::remove("o_0.obj");
  std::filesystem::remove("o_1.obj");

  io::write_weights("w.npy", WeightMatrix::Ones(4, model_points().cols()));
  const auto far = tetrahedron("v 1e308 0 0\nv 1e308 0 0\nv 1e308 0 0\nv 1e308 0 0\n", "far.obj");
  expect_deform(model + " --weights w.npy --pose " + rest + " " + far + " -o o_%d.obj", 2,
                "would not be finite");
  EXPECT_FALSE(std::filesystem::exists("o_0.obj"));
}

TEST_F(DeformCommand, WeightsOfAnotherModelAreRefused) {
  const auto rest = tetrahedron();
  const auto model = file("model.obj", kModel);
  PointList<3> points = model_points();
  points(1, 2) += 1e-3;
  const auto command =
      model + " --weights " + linear_weights(points) + " --pose " + rest + " -o o.obj -q";
  expect_deform(command + " --rest " + rest, 2,
                "they put vertex 2 of " + model + " at (0.5, 0.501, 0.5), not at (0.5, 0.5, ");
  EXPECT_FALSE(std::filesystem::exists("o.obj"));
  expect_deform(command);
  EXPECT_TRUE(std::filesystem::exists("o.obj"));
}

TEST_F(DeformCommand, FilesThatDoNotFitAndWrongUsage) {
  const auto cage = tetrahedron();
  const auto model = file("model.obj", kModel);
  const auto weights = " --weights " + linear_weights(model_points());
  const std::string output = " -o o.obj";
  const auto refused = [&](const std::string& arguments, int status, const std::string& words) {
    expect_deform(arguments, status, words);
    EXPECT_FALSE(std::filesystem::exists("o.obj"));
  };
  const auto posed = weights + " --pose " + cage;
  refused(model + weights + " --pose 3d/limb_cage.obj" + output, 2,
          "w.npy: has weights for 4 control points, but 3d/limb_cage.obj has 54");
  refused(cage + posed + " --pose 3d/limb_cage.obj -o o_%d.obj", 2,
          "3d/limb_cage.obj: has 54 vertices, but cage.obj has 4");
  EXPECT_FALSE(std::filesystem::exists("o_0.obj"));
  refused("3d/limb_model.obj" + posed + output, 2,
          "w.npy: has weights of 4 points, but 3d/limb_model.obj has 3352");
  refused(model + posed + " -o " + model, 1, "would replace this input file");
  refused(model + posed + " -o o.vtu", 1, "must end in .obj, .off, .ply");
  refused("model.vtk" + posed + output, 1, "model.vtk: unknown file format");
  refused(model + posed + " -o absent/o.obj", 4, "absent");
}

}  // namespace
}  // namespace flbc::testing
