// SPDX-License-Identifier: BSD-3-Clause
// Models that extend outside their cage, slightly or more, from the view of a user.
#include <regex>

#include "support/command_line.h"
#include "support/processor_time.h"

namespace flbc::testing {
namespace {

class OutsideCommand : public CommandLineTest {
 protected:
  // A triangle, two of whose corners are outside by so much.
  std::string model(const std::string& distance) const {
    return file("model.obj",
                "v 0.5 0.5 0\nv 0.3 -" + distance + " 0\nv -" + distance + " 0.6 0\nf 1 2 3\n");
  }
  std::string solve(const std::string& options) const {
    return "solve " + square() + " --vertices 300 --model model.obj -o w.npy --report report.json" +
           ' ' + options;
  }
};

// Vertices on the cage, slightly outside it, and duplicated, as in real models.
TEST_F(OutsideCommand, EmbeddingTakesModelsAsTheyAre) {
  const auto of = file("model.obj",
                       "v 0.5 0.5 0\nv 0.3 -0.0000001 0\nv 0.5 0.5 0\nv 1 1 0\nv 0.25 0.75 0\n"
                       "v 0 0.4 0\nv 0.25 0.75000000000001 0\nf 1 2 5\nf 3 4 6\n");
  expect(solve("--embed --save-domain domain.obj"));
  const auto weights = io::read_weights("w.npy").dense();
  ASSERT_EQ(weights.cols(), 7);
  EXPECT_EQ(weights.col(0), weights.col(2));
  EXPECT_LT((weights.col(4) - weights.col(6)).norm(), 1e-12);
  EXPECT_NEAR(weights(0, 1), 0.7, 1e-12);
  EXPECT_NEAR(weights(2, 3), 1, 1e-12);
  EXPECT_NEAR(weights(3, 5), 0.4, 1e-12);
  EXPECT_GE(weights.minCoeff(), 0);
  const auto domain = slurp("domain.obj");
  expect_piece(domain, "v 0.5 0.5");
  expect_piece(domain, "v 0.25 0.75");
  model("0.01");
  expect(solve("--embed"), 2, "2 of 3 vertices are outside the cage; the farthest is vertex");
}

TEST_F(OutsideCommand, FartherPointsGoTheWayThatIsAskedFor) {
  const auto of = model("0.25");
  expect(solve("--outside fail"), 2);
  expect(solve("--outside nearest"));
  const auto nearest = io::read_weights("w.npy").dense();
  EXPECT_GE(nearest.minCoeff(), 0);
  EXPECT_NEAR(nearest(0, 1), 0.7, 1e-12);  // (0.3, 0) between control points 0 and 1
  EXPECT_NEAR(nearest(1, 1), 0.3, 1e-12);
  EXPECT_EQ(json_in("report.json")["outside"]["outside"]["count"], 2);
  EXPECT_NEAR(json_in("report.json")["outside"]["outside"]["distance"], 0.25, 1e-12);
  EXPECT_EQ(json_in("report.json")["options"]["outside"], "nearest");
  expect(solve("--outside extend"));
  const auto extended = io::read_weights("w.npy").dense();
  EXPECT_NEAR(extended.col(1).sum(), 1, 1e-12);
  EXPECT_NEAR(extended(1, 1) + extended(2, 1), 0.3, 1e-12);    // x
  EXPECT_NEAR(extended(2, 1) + extended(3, 1), -0.25, 1e-12);  // y
  expect("deform " + of + " --weights w.npy --pose " + square() + " --rest " + square() +
         " -q -o moved.obj");
  expect("run " + square() + ' ' + of + " --outside nearest --vertices 300 -q -o out");
  expect("run " + square() + ' ' + of + " --outside extend --vertices 300 -q -o out", 1);
  expect(solve("--outside keep"), 0,
         "model.obj: 2 of 3 vertices are outside the cage, by up to 17.7% of its size; they stay");
  EXPECT_TRUE(io::read_weights("w.npy").dense().rightCols(2).isZero(0));
  expect(solve("--outside nearest --embed"), 1);
  expect(solve("--outside there"), 1);
}

// A box in a part of a mesh, as engineers deform meshes. The same in 2D, with a mesh of
// quadrilaterals, and in 3D, with a plate of triangles.
class BoxInMesh : public OutsideCommand, public ::testing::WithParamInterface<int> {
 protected:
  // The vertices of the mesh are at whole numbers, from 0 to 8 and 0 to 4. The box is from 1.5 to
  // 6.5, and above the middle of the mesh in y.
  static constexpr int kColumns = 9, kRows = 5;
  using Points = std::vector<Vector<3>>;

  BoxInMesh() {
    std::ostringstream mesh;
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < kColumns; ++x) mesh << "v " << x << ' ' << y << " 0\n";
    }
    for (int y = 1; y < kRows; ++y) {
      for (int x = 1; x < kColumns; ++x) {
        const int a = (y - 1) * kColumns + x;
        mesh << "f " << a << ' ' << a + 1 << ' ' << a + 1 + kColumns << ' ' << a + kColumns << '\n';
      }
    }
    file("mesh.obj", mesh.str());
    write_box("box.obj", box());
  }

  bool is_flat() const { return GetParam() == 2; }

  // In 2D the outline of the box, in 3D two of them.
  Points box() const {
    const Points outline = {{1.5, 1.5, 0}, {4, 1.5, 0}, {6.5, 1.5, 0},
                            {6.5, 5, 0},   {4, 5, 0},   {1.5, 5, 0}};
    if (is_flat()) return outline;
    Points points;
    for (const double z : {-1.0, 1.0}) {
      for (const auto& point : outline) points.push_back(point + Vector<3>(0, 0, z));
    }
    return points;
  }
  void write_box(const std::string& name, const Points& points) const {
    std::ostringstream text;
    text.precision(17);
    for (const auto& point : points) text << "v " << point.transpose() << '\n';
    if (is_flat()) {
      text << "l 1 2 3 4 5 6 1\n";
    } else {
      text << "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n";
      for (int k = 0; k < 6; ++k) {
        const int next = (k + 1) % 6;
        text << "f " << k + 1 << ' ' << next + 1 << ' ' << next + 7 << ' ' << k + 7 << '\n';
      }
    }
    file(name, text.str());
  }
  // The box with some control points moved: in 3D those in both planes.
  Points moved(const std::vector<int>& which, const Vector<3>& by) const {
    auto points = box();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (std::count(which.begin(), which.end(), static_cast<int>(i % 6)) > 0) points[i] += by;
    }
    return points;
  }
  static bool is_outside(const Vector<3>& point) {
    return point.x() < 1.5 || point.x() > 6.5 || point.y() < 1.5;
  }
  static double distance(const PointList<3>& a, const PointList<3>& b) {
    return (a - b).colwise().norm().maxCoeff();
  }
  Ended run_box(const std::string& policy, const std::string& options = "") {
    return expect("run box.obj mesh.obj --vertices 400 --pose pose.obj -o out --outside " + policy +
                  options);
  }
};

TEST_P(BoxInMesh, FiguresAreThoseOfTheFiles) {
  write_box("pose.obj", moved({1}, {0.2, 4.5, 0}));
  for (const std::string policy : {"nearest", "keep"}) {
    SCOPED_TRACE(policy);
    const auto ended = run_box(policy);
    const auto rest = points_in<3>("mesh.obj"), found = points_in<3>("out/deformed.obj");
    // x + sum_i w_i (c'_i - c_i), from files.
    const PointList<3> steps = points_in<3>("pose.obj") - points_in<3>("box.obj");
    const auto weights = io::read_weights("out/sparse_weights.mtx").dense();
    EXPECT_LT(distance(found, rest + steps * weights), 1e-12);
    const auto json = json_in("out/report.json");
    EXPECT_NEAR(json["deform"][0]["largest_displacement"], distance(found, rest), 1e-12);
    // The order of the corners turns.
    int inverted = 0;
    for (int y = 1; y < kRows; ++y) {
      for (int x = 1; x < kColumns; ++x) {
        const Index a = (y - 1) * kColumns + x - 1, d = a + kColumns;
        const Vector<3> one = found.col(d + 1) - found.col(a);
        const Vector<3> other = found.col(d) - found.col(a + 1);
        inverted += one.x() * other.y() - one.y() * other.x() <= 0 ? 1 : 0;
      }
    }
    ASSERT_GT(inverted, 0);
    const auto words = std::to_string(inverted) + " of 32 cells are inverted in pose.obj";
    EXPECT_EQ(ended.errors.find(words) != std::string::npos, is_flat()) << ended.errors;
    // The program deforms the same by the files.
    expect(
        "deform mesh.obj --rest box.obj --weights out/sparse_weights.mtx --pose pose.obj "
        "-q -o x.obj");
    EXPECT_LT(distance(points_in<3>("x.obj"), found), 1e-12);
  }
}

// A mesh is one in any format: its faces may turn over, and edges cross the border.
TEST_P(BoxInMesh, BinaryMeshesAreReportedAsTextIs) {
  write_box("pose.obj", moved({1}, {0.2, 4.5, 0}));
  run_box("keep");
  auto model = io::ModelFile("mesh.obj").model();
  model.is_text = false;
  io::write_model("mesh.ply", model);
  const std::string domain = is_flat() ? "out/domain.obj" : "out/domain.mesh";
  std::vector<std::string> warnings;
  for (const std::string extension : {"obj", "ply"}) {
    const auto ended = expect("deform mesh." + extension + " -o moved." + extension +
                              " --rest box.obj --weights out/domain_weights.npy --domain " +
                              domain + " --outside keep --pose pose.obj");
    std::string lines;
    std::istringstream all(ended.errors);
    for (std::string line; std::getline(all, line);) {
      if (line.compare(0, 6, "flbc: ") == 0) lines += line + '\n';
    }
    lines = std::regex_replace(lines, std::regex("\\.(obj|ply)"), "");
    expect_piece(lines, "the deformation jumps there by up to");
    EXPECT_EQ(lines.find("inverted") != std::string::npos, is_flat()) << lines;
    warnings.push_back(lines);
  }
  EXPECT_EQ(warnings[0], warnings[1]);
}

TEST_P(BoxInMesh, WhatIsKeptStaysAndTheBorderIsNamed) {
  // Control points 0 and 2 are where the mesh passes through the box, and 1 is between them.
  const Vector<3> shift(0, 0.5, 0);
  write_box("pose.obj", moved({1}, shift));
  const auto ended = run_box("keep");
  const auto rest = points_in<3>("mesh.obj"), found = points_in<3>("out/deformed.obj");
  for (Index p = 0; p < rest.cols(); ++p) {
    if (is_outside(rest.col(p))) {
      EXPECT_EQ(found.col(p), rest.col(p)) << p;
    }
  }
  // An edge of the mesh passes through the box at the control point that moves.
  expect_piece(ended.errors,
               "the deformation jumps there by up to 0.5, at the edge between "
               "vertices 22 and 13 in pose.obj");
  const auto border = json_in("out/report.json")["border"];
  EXPECT_NEAR(border["jumps"][0]["length"], 0.5, 1e-12);
  const std::vector<int> held = border["control_points"];
  // All but the middle of the top, which no edge of the mesh reaches.
  const std::vector<int> flat = {0, 1, 2, 3, 5}, solid = {0, 1, 2, 3, 5, 6, 7, 8, 9, 11};
  EXPECT_EQ(held, is_flat() ? flat : solid);

  write_box("pose.obj", moved({4}, shift));
  const auto still = run_box("keep");
  expect_no_piece(still.errors, "jump");
  EXPECT_GT(json_in("out/report.json")["deform"][0]["largest_displacement"], 0.1);
}

// Control point 4 is the only one that no facet at the border has.
TEST_P(BoxInMesh, AJointEndsTheDeformationSmoothly) {
  write_box("pose.obj", moved({4}, {0, 0.5, 0}));
  run_box("keep");
  const auto rest = points_in<3>("mesh.obj"), before = points_in<3>("out/deformed.obj");
  const std::string deform = "deform mesh.obj --weights out/binding.npz -o smooth.obj --pose ";
  const auto ended = expect(deform + "pose.obj --joint smooth");
  expect_piece(ended.errors, "mesh.obj: the joint holds control points 0, 1, 2, 3");
  expect_piece(ended.errors, "slope of the displacement at the border");
  expect_piece(expect("deform mesh.obj --weights out/binding.npz -o x.obj --pose pose.obj --joint "
                      "smooth:0.01")
                   .errors,
               "spans 1 cell; slope of the displacement");
  const auto after = points_in<3>("smooth.obj");
  for (Index p = 0; p < rest.cols(); ++p) {
    const double length = (before.col(p) - rest.col(p)).norm();
    const double mass = length / 0.5, t = std::min(1.0, mass / 0.5);
    EXPECT_NEAR((after.col(p) - rest.col(p)).norm(), t * (2 - t) * length, 1e-12) << p;
  }
  // The same in one command, whose binding has the joint.
  run_box("keep", " --joint smooth --force");
  EXPECT_LT(distance(points_in<3>("out/deformed.obj"), after), 1e-12);
  expect(deform + "pose.obj");
  EXPECT_LT(distance(points_in<3>("smooth.obj"), after), 1e-12);
  write_box("wrong.obj", moved({1}, {0, 0.5, 0}));
  expect(deform + "wrong.obj", 2, "control point 1 is held by the joint, but moves by 0.5");
  expect(deform + "pose.obj --joint round", 1, "use smooth or curvature");
}

TEST_P(BoxInMesh, FitAndAdjointReturnToTheCage) {
  write_box("pose.obj", moved({4}, {0, 0.5, 0}));
  run_box("keep");
  expect("fit mesh.obj out/deformed.obj --weights out/binding.npz --stiffness 0 --hold " +
             std::string(is_flat() ? "0,1,2,3,5" : "0,1,2,3,5,6,7,8,9,11") + " -o found.obj",
         0, "condition");
  EXPECT_LT(distance(points_in<3>("found.obj"), points_in<3>("pose.obj")), 1e-9);
  expect("fit mesh.obj out/deformed.obj --weights out/binding.npz --hold 99 -o found.obj", 2,
         "there is no control point 99");
  // J = sum of all coordinates, so that dJ/dc_i is the sum of the weights of i.
  const auto weights = io::read_weights("out/binding.npz").dense();
  const std::string row = is_flat() ? "1,1\n" : "1,1,1\n";
  std::string plain,
      su2 = "\"PointID\",\"x\",\"Sensitivity_x\",\"Sensitivity_y\",\"Sensitivity_z\"\n";
  for (Index p = 0; p < weights.cols(); ++p) {
    plain += row;
    su2 += std::to_string(weights.cols() - 1 - p) + ",0,1,1,1\n";
  }
  for (const auto& name : {file("ones.csv", plain), file("surface_adjoint.csv", su2)}) {
    expect("adjoint " + name + " --weights out/binding.npz -o dc.csv");
    const auto sums = io::read_weights("dc.csv").dense();
    ASSERT_EQ(sums.cols(), weights.rows());
    for (Index d = 0; d < sums.rows(); ++d) {
      EXPECT_LT((sums.row(d).transpose() - weights.rowwise().sum()).norm(), 1e-12) << name;
    }
  }
  expect("adjoint " + file("few.csv", row) + " --weights out/binding.npz -o dc.csv", 2,
         "few.csv: there are gradients of 1 points");
  const auto wrong =
      file("wrong.csv", "PointID,Sensitivity_x,Sensitivity_y,Sensitivity_z\n0,1,x,1\n");
  expect("adjoint " + wrong + " --weights out/binding.npz -o dc.csv", 2,
         "wrong.csv:2: expected a number in the column Sensitivity_y");
}

INSTANTIATE_TEST_SUITE_P(In, BoxInMesh, ::testing::Values(2, 3));

// Before anything that takes long.
TEST_F(OutsideCommand, RefusesBeforeTheMesherStarts) {
  const auto of = model("0.25");
  const double start = processor_seconds();
  expect("run " + square() + ' ' + of + " --vertices 900000 -o out", 2,
         "step mesh: model.obj: 2 of 3 vertices are outside the cage");
  EXPECT_LT(processor_seconds() - start, 10);  // the mesher would take 30
  EXPECT_FALSE(std::filesystem::exists("out/domain.obj"));
}

TEST_F(OutsideCommand, AsksAboutUnitsAndAxes) {
  const std::string cage = file("box.obj",
                                "v 0 0 0\nv 4 0 0\nv 0 2 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\n"
                                "f 2 3 4\nf 1 4 3\n");
  const std::string solve = "solve box.obj --method meanvalue -o w.npy --model ";
  const std::string faces = "f 1 2 3\n";
  expect(solve + file("tiny.obj", "v 0.1 0.1 0.1\nv 0.2 0.1 0.1\nv 0.1 0.1 0.2\n" + faces), 0,
         "tiny.obj: fills 0.00");
  expect(solve + file("up.obj", "v 0.1 7 -0.1\nv 0.2 6 -0.1\nv 0.1 5 -0.2\n" + faces), 2,
         "with y and z exchanged the model would fit");
  const auto fits = file("fits.obj", "v 0.1 0.1 0.1\nv 1 0.1 0.1\nv 0.1 1 0.1\n" + faces);
  expect_no_piece(expect(solve + fits).errors, "units");
  const auto outside = file("out.obj", "v 0.1 0.1 0.1\nv 9 9 9\nv 0.1 1 0.1\n" + faces);
  expect_no_piece(expect(solve + outside, 2).errors, "exchanged");
}

// Many files have vertices that belong to no face, such as those of lamps or of deleted parts.
TEST_F(OutsideCommand, VerticesOfNoFaceMayBeOutside) {
  const std::string faces = "f 1 2 3\nf 1 3 4\n";
  for (const std::string depth : {"0", "0.5"}) {
    SCOPED_TRACE(depth);
    const bool is_flat = depth == "0";
    file("cage.obj", is_flat ? "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nl 1 2 3 4 1\n"
                             : "v 0 0 0\nv 8 0 0\nv 0 8 0\nv 0 0 8\nf 1 3 2\nf 1 2 4\nf 2 3 4\n"
                               "f 1 4 3\n");
    const std::string model =
        "v 1 1 0\nv 2 1 0\nv 2 2 " + depth + "\nv 1 2 " + depth + "\nv 90 0 0\n";
    const std::string solve = "solve cage.obj --method meanvalue -o w.npy --model ";
    expect(solve + file("loose.obj", model + faces), 0, "1 of 5 vertices are outside the cage");
    expect("deform loose.obj --weights w.npy --rest cage.obj --pose cage.obj -o same.obj");
    expect_piece(slurp("same.obj"), "v 90 0 0");
    expect(solve + file("used.obj", model + faces + "f 1 2 5\n"), 2, "1 of 5 vertices are outside");
  }
}

}  // namespace
}  // namespace flbc::testing
