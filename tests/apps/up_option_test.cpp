// SPDX-License-Identifier: BSD-3-Clause
// --up of the commands that show or export models.
#include "front/up_axis.h"
#include "support/command_line.h"
#include "support/glb_file.h"
#include "support/usda_file.h"

namespace flbc::testing {
namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};

class UpOption : public CommandLineTest {
 protected:
  // A rotation that takes y to the axis.
  static Eigen::Matrix3d from_y(int axis) {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    if (axis == 0) turn << 0, 1, 0, -1, 0, 0, 0, 0, 1;
    if (axis == 2) turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    return turn;
  }

  static std::string vertices(const PointList<3>& points, int axis) {
    std::ostringstream text;
    for (const auto& point : points.colwise()) {
      const Vector<3> p = from_y(axis) * point;
      text << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    }
    return text.str();
  }

  // Vertices of a pyramid that stands along y.
  static PointList<3> pyramid() {
    PointList<3> points(3, 5);
    points << 0.1, 0.3, 0.3, 0.1, 0.2,  //
        0.1, 0.1, 0.1, 0.1, 0.35,       //
        0.1, 0.1, 0.25, 0.25, 0.2;
    return points;
  }

  // It stands along the axis, in a tetrahedron: MODEL and its options.
  std::string pyramid(int axis) const {
    const auto points = pyramid();
    PointList<3> cage(3, 4);
    cage << 0, 1, 0, 0,  //
        0, 0, 1, 0,      //
        0, 0, 0, 1;
    const auto weights = linear_weights(points);
    return file("model.obj",
                vertices(points, axis) + "f 1 2 3 4\nf 2 1 5\nf 3 2 5\nf 4 3 5\nf 1 4 5\n") +
           " --weights " + weights + " --cage " + tetrahedron(vertices(cage, axis));
  }
};

// Feet, ankles, and a head, as points, in all positions.
TEST_F(UpOption, FeetPointToTheFront) {
  const auto figure = [](double toes) {
    PointList<3> points(3, 10);
    points << -0.2, 0.2, -0.2, 0.2, -0.2, 0.2, -0.2, 0.2, -0.2, 0.2,  //
        0, 0, 0, 0, 0.12, 0.12, 0.12, 0.12, 1, 1,                     //
        -0.05, -0.05, toes, toes, -0.05, -0.05, 0.05, 0.05, 0, 0;
    return points;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (const int quarter : {-1, 0, 1, 2}) {
      const Eigen::AngleAxisd around(quarter * M_PI / 2, Vector<3>::UnitY());
      const PointList<3> points = from_y(axis) * around.toRotationMatrix() * figure(0.2);
      EXPECT_EQ(app::front_azimuth(axis, points), 90 * quarter) << axis;
    }
    EXPECT_EQ(app::front_azimuth(axis, from_y(axis) * figure(0.05)), 0);
  }
  PointList<3> lying = figure(-0.2);
  lying.row(1).tail(2).setConstant(0.12);
  lying.row(0) *= 0.01;
  lying(0, 8) = 3;
  EXPECT_EQ(app::front_azimuth(1, lying), 0);
}

TEST_F(UpOption, PicturesShowTheModelUpright) {
  const auto picture = [&](int axis, const std::string& up) {
    expect("draw " + pyramid(axis) + " -o p.svg --up " + up);
    return slurp("p.svg");
  };
  const auto upright = picture(1, "y");
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(picture(axis, kAxes[axis]), upright) << axis;
    EXPECT_EQ(picture(axis, "auto"), upright) << axis;
  }
  EXPECT_NE(picture(1, "z"), upright);
}

// About the origin, so that feet stay on the ground.
TEST_F(UpOption, SkinsTurnTheirRoot) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto poses = " --pose cage.obj pose.obj --fps 1";
    const auto model = pyramid(axis);
    PointList<3> moved(3, 4);
    moved << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
    moved.row(1).array() += 0.5;
    tetrahedron(vertices(moved, axis), "pose.obj");
    const auto expect_upright = [&](const Eigen::MatrixXd& points, const auto& sources, double y) {
      PointList<3> expected = pyramid()(Eigen::all, sources);
      expected.row(1).array() += y;
      EXPECT_LT((points - expected).norm(), 1e-6) << axis;
    };
    std::vector<Eigen::Index> sources;
    for (const std::string animation : {"", poses}) {
      expect("export " + model + animation + " -q -o s.glb");
      const auto skin = GlbFile(slurp("s.glb"));
      sources = skin.sources();
      expect_upright(skin.skinned(skin.joints()), sources, 0);
      EXPECT_EQ(skin.root_joint().contains("rotation"), axis != 1);
      if (!animation.empty()) expect_upright(skin.skinned(skin.joints(1)), sources, 0.5);
    }
    expect("export " + model + poses + " -q -o s.usda");
    const auto skin = UsdaFile(slurp("s.usda"));
    const double end = 24;
    expect_upright(skin.skinned(), sources, 0);
    expect_upright(skin.skinned(&end), sources, 0.5);
    EXPECT_EQ(skin.has("/model.xformOp:transform"), axis != 1);
  }
}

// In glTF y points up, even if a model lies.
TEST_F(UpOption, FilesThatKnowTheAxisAreNotTurned) {
  expect("convert " + pyramid(2).substr(0, pyramid(2).find(' ')) + " -q -o lying.glb");
  const auto rest = pyramid(2).substr(pyramid(2).find(' '));
  expect("export lying.glb" + rest + " -q -o s.glb");
  EXPECT_FALSE(GlbFile(slurp("s.glb")).root_joint().contains("rotation"));
  expect("export lying.glb" + rest + " -q -o s.glb --up z");
  EXPECT_TRUE(GlbFile(slurp("s.glb")).root_joint().contains("rotation"));
}

TEST_F(UpOption, PagesKnowTheAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto up = "\"up\":" + std::to_string(axis);
    expect("view " + pyramid(axis) + " -q -o p.html");
    expect_piece(slurp("p.html"), up);
    expect("view " + pyramid(1) + " -q -o p.html --up " + kAxes[axis]);
    expect_piece(slurp("p.html"), up);
  }
}

TEST_F(UpOption, IsForModelsIn3D) {
  const std::string cage = "2d/ring_cage.obj", model = "2d/ring_model.obj";
  expect("solve " + cage + " --vertices 500 -q --method harmonic --model " + model + " -o w.npy");
  const auto shape = model + " --weights w.npy --cage " + cage;
  expect("draw " + shape + " -o p.png --up z", 1, "--up is for models in");
  expect("view " + shape + " -o p.html --up x", 1, "--up is for models in 3D");
  expect("view " + shape + " -o p.html --up w", 1, "--up");
}

}  // namespace
}  // namespace flbc::testing
