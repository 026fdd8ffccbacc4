// SPDX-License-Identifier: BSD-3-Clause
// flbc compare, and other commands with kinds of coordinates for comparison.
#include "support/command_line.h"

namespace flbc::testing {
namespace {

using CompareCommand = CommandLineTest;

TEST_F(CompareCommand, ListsAllCoordinatesWithFilesThatExist) {
  for (const std::string dim : {"2d", "3d"}) {
    const auto folder = "compared_" + dim;
    const std::string name = dim == "2d" ? "2d/figure" : "3d/limb";
    expect("compare " + name + "_cage.obj " + name + "_model.obj --pose " + name +
           "_cage.obj -q --vertices 500 -o " + folder);
    const auto report = json_in(folder + "/table.json");
    const auto& columns = report["columns"];
    EXPECT_EQ(columns.size(), dim == "2d" ? 8U : 7U);
    for (const auto& [method, facts] : columns.items()) {
      EXPECT_LT(facts["sum_error"], 1e-12) << method;
      const double reproduction = facts["reproduction_error"];
      EXPECT_EQ(reproduction > 1e-3, method == "bbw") << method;
      EXPECT_EQ(reproduction > 1e-11, method == "bbw") << method;
      // Harmonic coordinates may be negative on a coarse mesh.
      if (method != "harmonic") {
        const bool has_negative = method == "meanvalue" || method == "green";
        EXPECT_EQ(facts["min_weight"] < 0, has_negative) << method;
      }
    }
    EXPECT_LT(columns["local"]["influences"], columns["harmonic"]["influences"]);
    for (const auto& file : report["files"]) {
      EXPECT_TRUE(std::filesystem::exists(folder + "/" + file.get<std::string>())) << file;
    }
    expect_piece(slurp(folder + "/index.html"), "maxlikelihood");
  }
}

TEST_F(CompareCommand, TheMeshWithoutAModelHasTheRowOfCheck) {
  const std::string folder = "compared";
  expect("compare 2d/figure_cage.obj -q --vertices 500 --methods local,meanvalue -o " + folder);
  const auto columns = json_in(folder + "/table.json")["columns"];
  for (const std::string name : {"local", "meanvalue"}) {
    expect("check 2d/figure_cage.obj --domain " + folder + "/domain.obj --weights " + folder +
           "/weights_" + name + ".npy --json check.json");
    const auto properties = json_in("check.json")["weights"]["properties"];
    EXPECT_EQ(properties.size(), 7U);
    for (const auto& [key, value] : properties.items()) {
      EXPECT_NEAR(value.get<double>(), columns[name][key].get<double>(), 1e-9) << name << key;
    }
  }
}

// All coordinates but bbw and green reproduce affine maps, so the measures of poses are known.
TEST_F(CompareCommand, DistortionOfAffinePosesIsThatOfTheMap) {
  for (const std::string dim : {"2d", "3d"}) {
    const std::string cage = dim == "2d" ? "2d/figure_cage.obj" : "3d/limb_cage.obj";
    const auto measure = [&](const Eigen::Matrix3d& map) {
      moved(cage, "posed.obj", [&](const auto& point) { return map * point; });
      expect("compare " + cage + " -q --vertices 500 --methods local,meanvalue --force --pose " +
             "posed.obj -o compared");
      return json_in("compared/table.json")["columns"];
    };
    const Eigen::Matrix3d turn{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    const Eigen::Matrix3d stretch = Vector<3>(1.5, 2, 1).asDiagonal();
    const Eigen::Matrix3d image = Vector<3>(-1, 1, 1).asDiagonal();
    for (const auto& [map, distortion, volume_change, flipped] :
         {std::tuple(turn, 0.0, 0.0, 0.0), {stretch, 0.25 + 1, 2.0, 0.0}, {image, 0.0, 2.0, 1.0}}) {
      const auto columns = measure(map);
      for (const auto& [name, facts] : columns.items()) {
        EXPECT_NEAR(facts["distortion"].get<double>(), distortion, 1e-9) << name;
        EXPECT_NEAR(facts["volume_change"].get<double>(), volume_change, 1e-9) << name;
        EXPECT_NEAR(facts["flipped"].get<double>(), flipped, flipped * 1e-12) << name;
      }
    }
  }
}

TEST_F(CompareCommand, ReplacesOnlyItsOwnFilesWithoutForce) {
  const std::string compare =
      "compare 2d/figure_cage.obj -q --vertices 300 --methods meanvalue -o compared";
  expect(compare);
  expect(compare);
  std::filesystem::remove("compared/table.json");
  expect(compare, 1, "--force");
  expect(compare + " --force");
}

TEST_F(CompareCommand, AMethodThatFailsSaysWhyAndTheOthersContinue) {
  expect("compare 3d/limb_cage.obj -q --vertices 500 --methods blended,meanvalue -o compared");
  const auto report = json_in("compared/table.json");
  EXPECT_EQ(report["columns"].size(), 1U);
  expect_piece(report["failures"]["blended"].get<std::string>(), "in 2D");
  expect_piece(slurp("compared/index.html"), "blended failed: ");
}

TEST_F(CompareCommand, GreenCoordinatesAndBiharmonicWeightsDeformModels) {
  const std::string cage = "2d/figure_cage.obj";
  const auto deform = "deform 2d/figure_model.obj -q --rest " + cage + " --pose " + cage +
                      " -o moved.obj --displacement lengths.csv";
  expect("solve " + cage +
         " -q --vertices 500 --method bbw --model 2d/figure_model.obj -o bbw.npy");
  for (const std::string way : {" --method green", " --relative --weights bbw.npy"}) {
    expect(deform + way);
    EXPECT_LT(io::read_weights("lengths.csv").dense().maxCoeff(), 1e-10) << way;
  }
  expect(deform + " --weights bbw.npy", 2, "--relative");
  expect(deform, 1, "--method green");
  expect("deform 2d/figure_model.obj --method green --pose " + cage + " -o m.obj", 1, "--rest");
  expect("solve " + cage + " --method green -o w.npy", 1, "flbc deform --method green");
  expect("run " + cage + " --method green -o run", 1, "flbc deform --method green");
  expect("run " + cage + " --method bbw -o run", 1, "flbc deform --relative");
}

TEST_F(CompareCommand, SolvesWithoutAMeshAsOnTheVerticesThemselves) {
  for (const std::string method : {"meanvalue", "maxentropy", "maxlikelihood", "blended"}) {
    expect("solve 2d/figure_cage.obj -q --vertices 500 --method " + method +
           " --save-domain domain.obj -o mesh.npy");
    expect("solve 2d/figure_cage.obj -q --method " + method +
           " --model domain.obj -o model.npy --report model.json");
    const auto on_mesh = io::read_weights("mesh.npy").dense();
    const auto at_model = io::read_weights("model.npy").dense();
    EXPECT_LT((on_mesh - at_model).cwiseAbs().maxCoeff(), 1e-9) << method;
    EXPECT_EQ(json_in("model.json")["vertices"], 0);
  }
}

}  // namespace
}  // namespace flbc::testing
