// SPDX-License-Identifier: BSD-3-Clause
// flbc compare, and flbc solve with methods that need no mesh.
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
    EXPECT_EQ(columns.size(), dim == "2d" ? 7U : 6U);
    for (const auto& [method, facts] : columns.items()) {
      EXPECT_LT(facts["sum_error"], 1e-12) << method;
      EXPECT_LT(facts["reproduction_error"], 1e-11) << method;
      // Harmonic coordinates may be negative on a coarse mesh.
      if (method != "harmonic") {
        EXPECT_EQ(facts["min_weight"] < 0, method == "meanvalue") << method;
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

TEST_F(CompareCommand, AMethodThatFailsSaysWhyAndTheOthersContinue) {
  const auto folder = path("compared");
  expect("compare " + sample("3d/limb_cage.obj") +
         " -q --vertices 500 --methods blended,meanvalue" + " -o " + folder);
  const auto report = nlohmann::json::parse(slurp(folder + "/table.json"));
  EXPECT_EQ(report["columns"].size(), 1U);
  EXPECT_NE(report["failures"]["blended"].get<std::string>().find("in 2D"), std::string::npos);
  EXPECT_NE(slurp(folder + "/table.txt").find("blended failed: "), std::string::npos);
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
