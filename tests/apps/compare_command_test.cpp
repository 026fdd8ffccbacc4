// SPDX-License-Identifier: BSD-3-Clause
// flbc compare, and other commands with kinds of coordinates for comparison.
#include <filesystem>
#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include "flbc/io/weights_io.h"
#include "support/command_line.h"

namespace flbc::testing {
namespace {

using CompareCommand = CommandLineTest;

TEST_F(CompareCommand, ListsAllCoordinatesWithFilesThatExist) {
  for (const std::string dim : {"2d", "3d"}) {
    const auto folder = path("compared_" + dim);
    const std::string name = dim == "2d" ? "2d/figure" : "3d/limb";
    expect("compare " + sample(name + "_cage.obj") + " " + sample(name + "_model.obj") +
           " --pose " + sample(name + "_cage.obj") + " -q --vertices 800 -o " + folder);
    const auto report = nlohmann::json::parse(slurp(folder + "/table.json"));
    const auto& columns = report["columns"];
    EXPECT_EQ(columns.size(), dim == "2d" ? 9U : 8U);
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
    EXPECT_LT(columns["local"]["influences"], columns["local_smooth"]["influences"]);
    for (const auto& file : report["files"]) {
      EXPECT_TRUE(std::filesystem::exists(folder + "/" + file.get<std::string>())) << file;
    }
    EXPECT_NE(slurp(folder + "/index.html").find("maxlikelihood"), std::string::npos);
  }
}

TEST_F(CompareCommand, TheMeshWithoutAModelHasTheRowOfCheck) {
  const auto folder = path("compared");
  const auto cage = sample("2d/figure_cage.obj");
  expect("compare " + cage + " -q --vertices 500 --methods local,meanvalue -o " + folder);
  const auto columns = nlohmann::json::parse(slurp(folder + "/table.json"))["columns"];
  for (const std::string name : {"local", "local_smooth", "meanvalue"}) {
    expect("check " + cage + " --domain " + folder + "/domain.obj --weights " + folder +
           "/weights_" + name + ".npy --json " + path("check.json"));
    const auto properties =
        nlohmann::json::parse(slurp(path("check.json")))["weights"]["properties"];
    EXPECT_EQ(properties.size(), 7U);
    for (const auto& [key, value] : properties.items()) {
      EXPECT_NEAR(value.get<double>(), columns[name][key].get<double>(), 1e-9) << name << key;
    }
  }
}

TEST_F(CompareCommand, ReplacesOnlyItsOwnFilesWithoutForce) {
  const auto folder = path("compared");
  const auto compare = "compare " + sample("2d/figure_cage.obj") +
                       " -q --vertices 300 --methods meanvalue -o " + folder;
  expect(compare);
  expect(compare);
  std::filesystem::remove(folder + "/table.json");
  expect(compare, 1, "--force");
  expect(compare + " --force");
}

TEST_F(CompareCommand, PicturesAreSeenAsThoseOfDraw) {
  const auto cage = sample("3d/limb_cage.obj"), model = sample("3d/limb_model.obj");
  const auto grid = [&](const std::string& options) {
    expect("compare " + cage + " " + model + " -q --vertices 300 --methods meanvalue --pictures svg" + options +
           " -o " + path("compared"));
    return slurp(path("compared/functions.svg"));
  };
  const auto usual = grid("");
  EXPECT_EQ(grid(" --view 35,18"), usual);
  EXPECT_NE(grid(" --view 215,18"), usual);
  EXPECT_NE(grid(" --up x"), usual);
  expect("compare " + cage + " --view back -o " + path("compared"), 1, "AZIMUTH,ELEVATION");
  expect("compare " + sample("2d/figure_cage.obj") + " --up z -o " + path("compared"), 1,
         "models in 3D");
}

TEST_F(CompareCommand, AMethodThatFailsSaysWhyAndTheOthersContinue) {
  const auto folder = path("compared");
  expect("compare " + sample("3d/limb_cage.obj") +
         " -q --vertices 500 --methods blended,meanvalue" + " -o " + folder);
  const auto report = nlohmann::json::parse(slurp(folder + "/table.json"));
  EXPECT_EQ(report["columns"].size(), 1U);
  EXPECT_NE(report["failures"]["blended"].get<std::string>().find("in 2D"), std::string::npos);
  EXPECT_NE(slurp(folder + "/table.txt").find("blended failed: "), std::string::npos);
}

TEST_F(CompareCommand, GreenCoordinatesAndBiharmonicWeightsDeformModels) {
  const auto cage = sample("2d/figure_cage.obj");
  const auto model = sample("2d/figure_model.obj");
  const auto deform = "deform " + model + " -q --rest " + cage + " --pose " + cage + " -o " +
                      path("moved.obj") + " --displacement " + path("lengths.csv");
  expect("solve " + cage + " -q --vertices 500 --method bbw --model " + model + " -o " +
         path("bbw.npy"));
  const auto relative = " --relative --weights " + path("bbw.npy");
  for (const std::string& way : {std::string(" --method green"), relative}) {
    expect(deform + way);
    EXPECT_LT(io::read_weights(path("lengths.csv")).maxCoeff(), 1e-10) << way;
  }
  expect(deform + " --weights " + path("bbw.npy"), 2, "--relative");
  expect(deform, 1, "--method green");
  expect("deform " + model + " --method green --pose " + cage + " -o " + path("m.obj"), 1,
         "--rest");
  expect("solve " + cage + " --method green -o " + path("w.npy"), 1, "flbc deform --method green");
  expect("run " + cage + " --method green -o " + path("run"), 1, "flbc deform --method green");
  expect("run " + cage + " --method bbw -o " + path("run"), 1, "flbc deform --relative");
}

TEST_F(CompareCommand, SolvesWithoutAMeshAsOnTheVerticesThemselves) {
  const auto cage = sample("2d/figure_cage.obj");
  for (const std::string method : {"meanvalue", "maxentropy", "maxlikelihood", "blended"}) {
    expect("solve " + cage + " -q --vertices 500 --method " + method + " --save-domain " +
           path("domain.obj") + " -o " + path("mesh.npy"));
    expect("solve " + cage + " -q --method " + method + " --model " + path("domain.obj") + " -o " +
           path("model.npy") + " --report " + path("model.json"));
    const auto on_mesh = io::read_weights(path("mesh.npy"));
    const auto at_model = io::read_weights(path("model.npy"));
    EXPECT_LT((on_mesh - at_model).cwiseAbs().maxCoeff(), 1e-9) << method;
    EXPECT_EQ(nlohmann::json::parse(slurp(path("model.json")))["vertices"], 0);
  }
}

}  // namespace
}  // namespace flbc::testing
