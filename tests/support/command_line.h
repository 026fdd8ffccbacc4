// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Runs the program FLBC_PROGRAM as its users do, and includes what tests of its files need.
#pragma once

#include <sys/wait.h>

#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "flbc/io/cage_io.h"
#include "flbc/io/model_file.h"
#include "flbc/io/weights_io.h"
#include "support/scratch.h"
#include "support/test.h"

namespace flbc::testing {

//! Exit status and output of a run.
struct Ended {
  int status;
  std::string output;
  std::string errors;
};

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

  // \return the exit status, -1 if a signal ended the command
  static int status_of(const std::string& command) {
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  static bool has_program(const std::string& name) {
    return status_of("command -v " + name + " >/dev/null 2>&1") == 0;
  }

  static Ended run(const std::string& arguments) {
    const int status =
        status_of(FLBC_PROGRAM " " + arguments + " >stdout.txt 2>stderr.txt </dev/null");
    Ended result{status, slurp("stdout.txt"), slurp("stderr.txt")};
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
    expect_piece(result.errors, words);
    const std::set<std::string> printing{"check", "info"};
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

  // Writes a model with its points moved. \return its name
  template <class Move>
  static std::string moved(const std::string& from, const std::string& to, const Move& move) {
    auto soup = io::read_polygons(from);
    for (auto& point : soup.points) point = move(point);
    io::write_model(to, {soup});
    return to;
  }

  static std::string square() {
    return file("square.obj", "v 0 0\nv 1 0\nv 1 1\nv 0 1\nl 1 2 3 4 1\n");
  }

  // A tetrahedron as cage, whose weights are known: x, y, z and what is left to 1.
  static std::string tetrahedron(
      const std::string& vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n",
      const std::string& name = "cage.obj") {
    return file(name, vertices + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  }
  // The same for the triangle of the origin and the unit vectors of the plane.
  static std::string linear_weights(const Eigen::MatrixXd& points) {
    WeightMatrix weights(points.rows() + 1, points.cols());
    weights << 1 - points.colwise().sum().array(), points;
    io::write_weights("w.npy", weights);
    return "w.npy";
  }

 private:
  const ScratchFolder folder_;
};

}  // namespace flbc::testing
