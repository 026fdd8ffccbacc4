// SPDX-License-Identifier: BSD-3-Clause
// flbc solve --cache as its users and their scripts see it.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include "support/command_line.h"

namespace flbc::testing {
namespace {

namespace fs = std::filesystem;

class CacheCommand : public CommandLineTest {
 protected:
  // Solves with the cache; everything that is written is in files called `name`.
  Ended solve(const std::string& arguments, const std::string& name) const {
    return run("solve " + arguments + " --cache " + path("cache") + " -o " + path(name + ".npy") +
               " --report " + path(name + ".json"));
  }
  void expect_solved(const std::string& arguments, const std::string& name, bool cached) const {
    SCOPED_TRACE(arguments);
    const auto result = solve(arguments, name);
    ASSERT_EQ(result.status, 0) << result.errors;
    EXPECT_EQ(report(name)["cached"], cached);
    EXPECT_EQ(result.errors.find("from the cache") != std::string::npos, cached) << result.errors;
  }
  nlohmann::json report(const std::string& name) const {
    return nlohmann::json::parse(slurp(path(name + ".json")));
  }
  std::vector<fs::path> entries() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(path("cache"))) files.push_back(entry.path());
    return files;
  }
};

const char* const kFast = " --tolerance 1e-3 ";

TEST_F(CacheCommand, GivesTheSameBytesAgain) {
  for (const std::string name : {"2d/letter", "3d/torus"}) {
    const std::string domain = name[0] == '2' ? "d.obj" : "d.mesh";
    const auto cage = sample(name + "_cage.obj") + kFast + "--vertices 1500 --save-domain ";
    expect_solved(cage + path("a_" + domain), "a", false);
    expect_solved(cage + path("b_" + domain) + " --threads 1 -v", "b", true);
    EXPECT_EQ(slurp(path("a.npy")), slurp(path("b.npy")));
    EXPECT_EQ(slurp(path("a_" + domain)), slurp(path("b_" + domain)));
    EXPECT_NE(slurp(path("a.npy")), "");
    // But for these two, the reports are the same.
    auto first = report("a");
    auto second = report("b");
    for (auto* json : {&first, &second}) {
      json->erase("cached");
      json->at("options").erase("threads");
    }
    EXPECT_EQ(first, second);

    // The mesh of the first run, from its file: other keys, the same weights.
    const auto given = sample(name + "_cage.obj") + kFast + "--domain " + path("a_" + domain);
    expect_solved(given, "c", false);
    expect_solved(given, "d", true);
    EXPECT_EQ(slurp(path("c.npy")), slurp(path("a.npy")));
    EXPECT_EQ(slurp(path("d.npy")), slurp(path("a.npy")));
  }
}

TEST_F(CacheCommand, ServesEveryModelInTheCage) {
  const auto cage = sample("2d/ring_cage.obj") + kFast + "--vertices 1500";
  const auto model = " --model " + sample("2d/ring_model.obj");
  ASSERT_EQ(run("solve " + cage + model + " -o " + path("plain.npy")).status, 0);
  expect_solved(cage, "a", false);
  expect_solved(cage + model, "b", true);
  EXPECT_EQ(slurp(path("plain.npy")), slurp(path("b.npy")));
  // A model that is part of the mesh makes another one.
  expect_solved(sample("2d/ring_cage.obj") + kFast + model + " --embed", "c", false);
  expect_solved(sample("2d/ring_cage.obj") + kFast + model + " --embed", "d", true);
  EXPECT_EQ(slurp(path("c.npy")), slurp(path("d.npy")));
  // Names are of no interest, numbers are.
  file("copy.obj", slurp(sample("2d/ring_cage.obj")));
  expect_solved(path("copy.obj") + kFast + "--vertices 1500", "e", true);
  auto moved = slurp(sample("2d/ring_cage.obj"));
  const auto digit = moved.find(' ', moved.find("\nv ") + 3) - 1;
  moved[digit] = moved[digit] == '1' ? '2' : '1';
  file("copy.obj", moved);
  expect_solved(path("copy.obj") + kFast + "--vertices 1500", "f", false);
  // A model outside is refused as ever.
  EXPECT_EQ(solve(cage + " --model " + sample("2d/figure_model.obj"), "g").status, 2);
}

TEST_F(CacheCommand, DamageIsToldAndMended) {
  const auto cage = sample("2d/letter_cage.obj") + " --method harmonic --vertices 500";
  expect_solved(cage, "a", false);
  const auto entry = entries().at(0);
  const auto good = slurp(entry);
  auto flipped = good;
  flipped[good.size() / 2] ^= 1;
  const std::string damages[] = {flipped, good.substr(0, good.size() - 1), "", "something else"};
  for (const auto& damage : damages) {
    std::ofstream(entry, std::ios::binary) << damage;
    const auto result = solve(cage + " -q", "b");
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
    EXPECT_NE(result.errors.find(entry.string() + ": not used"), std::string::npos)
        << result.errors;
    EXPECT_EQ(report("b")["cached"], false);
    EXPECT_EQ(slurp(path("b.npy")), slurp(path("a.npy")));
    expect_solved(cage, "c", true);
    EXPECT_EQ(slurp(path("c.npy")), slurp(path("a.npy")));
  }
  EXPECT_EQ(entries().size(), 1U);
}

TEST_F(CacheCommand, KeepsOnlyWhatHasConverged) {
  const auto cage = sample("2d/letter_cage.obj") + " --vertices 500 --max-iterations 10";
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(solve(cage, "a").status, 3);
    EXPECT_EQ(report("a")["cached"], false);
  }
  EXPECT_TRUE(entries().empty());
}

TEST_F(CacheCommand, FoldersThatCannotBeUsedAreNamedFirst) {
  const auto cage = sample("2d/letter_cage.obj") + " --vertices 500 -o " + path("w.npy");
  const auto result = run("solve " + cage + " --cache " + file("file", "") + "/cache");
  EXPECT_EQ(result.status, 4);
  EXPECT_NE(result.errors.find("--cache " + path("file") + "/cache: cannot make this folder"),
            std::string::npos)
      << result.errors;
  EXPECT_FALSE(fs::exists(path("w.npy")));
  EXPECT_EQ(run("solve " + cage + " --cache ''").status, 1);
}

TEST_F(CacheCommand, TwoProgramsShareAFolder) {
  // Both compute, both write; whoever comes last finds a sound file.
  const auto solve_once = [&](const std::string& name) {
    return std::string(FLBC_PROGRAM) + " solve " + sample("2d/letter_cage.obj") +
           " --method harmonic --vertices 2000 -q --cache " + path("cache") + " -o " +
           path(name + ".npy");
  };
  const auto pair = solve_once("a") + " & " + solve_once("b") + " & wait";
  for (int k = 0; k < 3; ++k) {
    fs::remove_all(path("cache"));
    ASSERT_EQ(std::system(("(" + pair + ") >" + path("log") + " 2>&1 </dev/null").c_str()), 0);
    EXPECT_EQ(slurp(path("log")), "");
    EXPECT_EQ(slurp(path("a.npy")), slurp(path("b.npy")));
    EXPECT_NE(slurp(path("a.npy")), "");
    EXPECT_EQ(entries().size(), 1U);  // no temporary file is left
    expect_solved(sample("2d/letter_cage.obj") + " --method harmonic --vertices 2000", "c", true);
    EXPECT_EQ(slurp(path("c.npy")), slurp(path("a.npy")));
  }
}

}  // namespace
}  // namespace flbc::testing
