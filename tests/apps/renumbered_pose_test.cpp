// SPDX-License-Identifier: BSD-3-Clause
// Poses whose files have the control points in another order.
#include "support/command_line.h"

namespace flbc::testing {
namespace {

class RenumberedPose : public CommandLineTest {
 protected:
  // The same surface or outline, with its vertices in another order.
  static void renumber(const std::string& from, const std::string& to) {
    auto soup = io::read_polygons(from);
    std::vector<Index> numbers(soup.points.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    std::shuffle(numbers.begin(), numbers.end(), std::mt19937(1));
    const auto points = soup.points;
    for (std::size_t v = 0; v < points.size(); ++v) soup.points[numbers[v]] = points[v];
    for (auto* polygons : {&soup.polygons, &soup.polylines}) {
      for (auto& polygon : *polygons) {
        for (Index& vertex : polygon) vertex = numbers[vertex];
      }
    }
    io::write_model(to, {soup});
  }

  void expect_same_results(const std::string& name) const {
    SCOPED_TRACE(name);
    const auto cage = name + "_cage.obj", model = name + "_model.obj";
    expect("solve " + cage + " --model " + model + " --method meanvalue -o w.npy");
    for (const auto& [file, number] : {std::pair{"_cage_pose.obj", "0"}, {"_cage.obj", "1"}}) {
      io::write_model("plain_" + std::string(number) + ".obj", {io::read_polygons(name + file)});
      renumber(name + file, "pose_" + std::string(number) + ".obj");
    }
    const std::string note = "the vertices have other numbers than those of " + cage;
    const auto deform = "deform " + model + " --weights w.npy --rest " + cage + " --pose ";
    expect(deform + "plain_0.obj -o plain_d.obj");
    expect(deform + "pose_0.obj -o pose_d.obj", 0, note);
    EXPECT_EQ(slurp("plain_d.obj"), slurp("pose_d.obj"));
    expect(deform + "pose_%d.obj -o out_%d.obj", 0, note);
    EXPECT_EQ(slurp("out_0.obj"), slurp("plain_d.obj"));

    const auto exports = "export " + model + " --weights w.npy --cage " + cage + " --pose ";
    expect(exports + "plain_%d.obj -o plain.glb");
    expect_piece(expect(exports + "pose_%d.obj -o pose.glb").errors, note);
    EXPECT_EQ(slurp("plain.glb"), slurp("pose.glb"));

    // Without a rest cage, a sequence must be of one cage.
    expect("deform " + model + " --weights w.npy --pose plain_0.obj pose_1.obj -o out_%d.obj", 0,
           "other numbers than those of plain_0.obj");
    EXPECT_EQ(slurp("out_0.obj"), slurp("plain_d.obj"));
  }
};

TEST_F(RenumberedPose, MovesTheModelAsTheOriginalIn2D) {
  expect_same_results("2d/figure");
}

TEST_F(RenumberedPose, MovesTheModelAsTheOriginalIn3D) {
  expect_same_results("3d/limb");
}

TEST_F(RenumberedPose, RunAppliesIt) {
  renumber("2d/figure_cage_pose.obj", "pose.obj");
  const std::string run = "run 2d/figure_cage.obj --vertices 500 --method harmonic --pose ";
  expect(run + "2d/figure_cage_pose.obj -o plain");
  expect(run + "pose.obj -o out", 0, "the vertices have other numbers");
  EXPECT_EQ(slurp("out/deformed.obj"), slurp("plain/deformed.obj"));
}

TEST_F(RenumberedPose, AnotherCageWithAsManyPointsIsRefused) {
  file("cage.obj",
       "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 3 0 0\nv 4 0 0\nv 4 1 0\nv 3 1 0\n"
       "l 1 2 3 4 1\nl 5 6 7 8 5\n");
  file("other.obj",
       "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 3 0 0\nv 4 0 0\nv 4 1 0\nv 3 1 0\n"
       "l 1 2 3 4 5 6 7 8 1\n");
  expect_refused("run cage.obj --pose other.obj -o out", 2,
                 "other.obj: face 0 joins vertices 0 1 2 3 4 5 6 7, but cage.obj has no such face");
}

TEST_F(RenumberedPose, AFileThatIsThereIsNoPattern) {
  std::filesystem::copy_file("2d/figure_cage_pose.obj", "percent%d.obj");
  expect("run 2d/figure_cage.obj --vertices 500 --method harmonic --pose percent%d.obj -o out", 0,
         "percent%d.obj");
}

}  // namespace
}  // namespace flbc::testing
