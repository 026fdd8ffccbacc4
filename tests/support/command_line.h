// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Runs the program FLBC_PROGRAM as its users do.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "flbc/io/cage_io.h"
#include "flbc/io/model_file.h"
#include "flbc/io/weights_io.h"
#include "support/scratch.h"

namespace flbc::testing {

//! Exit status and output of a run.
struct Ended {
  int status;
  std::string output;
  std::string errors;
};

//! The whole content of a file; empty if there is none.
inline std::string slurp(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline nlohmann::json json_in(const std::string& path) {
  return nlohmann::json::parse(slurp(path));
}

//! The vertices of a model.
template <int Dim>
PointList<Dim> points_in(const std::string& path) {
  return io::to_points<Dim>(io::read_polygons(path), path);
}

//! The working directory is a new folder for every test, with links to the samples: 2d and 3d.
class CommandLineTest : public ::testing::Test {
 protected:
  CommandLineTest() {
    std::filesystem::current_path(folder_.path());
    for (const char* dim : {"2d", "3d"}) {
      std::filesystem::create_directory_symlink(std::string(FLBC_MESHES_DIR "/") + dim, dim);
    }
  }
  ~CommandLineTest() override { std::filesystem::current_path("/"); }

  static std::string file(const std::string& name, const std::string& content) {
    std::ofstream(name) << content;
    return name;
  }

  static Ended run(const std::string& arguments) {
    const std::string command =
        FLBC_PROGRAM " " + arguments + " >stdout.txt 2>stderr.txt </dev/null";
    const int status = std::system(command.c_str());
    Ended result{WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp("stdout.txt"),
                 slurp("stderr.txt")};
    std::filesystem::remove("stdout.txt");
    std::filesystem::remove("stderr.txt");
    return result;
  }

  // Expects an exit status and words in the messages, and nothing on standard output but from
  // commands that are there to print.
  static Ended expect(const std::string& arguments, int status = 0, const std::string& words = "") {
    SCOPED_TRACE(arguments);
    auto result = run(arguments);
    EXPECT_EQ(result.status, status) << result.errors;
    EXPECT_NE(result.errors.find(words), std::string::npos) << result.errors;
    const std::set<std::string> printing{"check", "completion", "info", "man"};
    if (printing.count(arguments.substr(0, arguments.find(' '))) == 0) {
      EXPECT_EQ(result.output, "");
    }
    return result;
  }

  // Expects also that no file is left behind.
  static void expect_refused(const std::string& arguments, int status, const std::string& words) {
    const auto count_files = [] {
      return std::distance(std::filesystem::directory_iterator("."), {});
    };
    const auto before = count_files();
    expect(arguments, status, words);
    EXPECT_EQ(count_files(), before) << arguments;
  }

  // Harmonic coordinates of a sample at its model (w.npy) and on a mesh (v.npy, domain_file).
  static void solve(const std::string& name, const std::string& domain_file) {
    const auto command = "solve " + name + "_cage.obj --method harmonic -q -o ";
    expect(command + "w.npy --vertices 1500 --save-domain " + domain_file + " --model " + name +
           "_model.obj");
    expect(command + "v.npy --domain " + domain_file);
  }

  // A tetrahedron as cage, whose weights are known: x, y, z and what is left to 1.
  static std::string tetrahedron(
      const std::string& vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n",
      const std::string& name = "cage.obj") {
    return file(name, vertices + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  }
  static std::string linear_weights(const PointList<3>& points) {
    WeightMatrix weights(4, points.cols());
    weights << 1 - points.colwise().sum().array(), points;
    io::write_weights("w.npy", weights);
    return "w.npy";
  }

 private:
  const ScratchFolder folder_;
};

}  // namespace flbc::testing
