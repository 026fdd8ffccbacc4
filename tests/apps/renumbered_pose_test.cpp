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

  // With and without a rest cage.
  void expect_all_refuse(const std::string& name) const {
    SCOPED_TRACE(name);
    const auto cage = name + "_cage.obj", model = name + "_model.obj";
    expect("solve " + cage + " --model " + model + " --method meanvalue -o w.npy");
    renumber(cage, "pose.obj");
    const std::string words = "pose.obj: face 0 joins vertices ";
    expect_refused("run " + cage + " " + model + " --pose pose.obj -o out", 2, words);
    expect_refused(
        "export " + model + " --weights w.npy --cage " + cage + " --pose pose.obj -o skin.glb", 2,
        words);
    const auto deform = "deform " + model + " --weights w.npy -o moved_%d.obj ";
    expect_refused(deform + "--rest " + cage + " --pose pose.obj", 2, words);
    expect_refused(deform + "--pose " + cage + " pose.obj", 2, words);
  }
};

TEST_F(RenumberedPose, IsRefusedIn2D) {
  expect_all_refuse("2d/figure");
}

TEST_F(RenumberedPose, IsRefusedIn3D) {
  expect_all_refuse("3d/limb");
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
