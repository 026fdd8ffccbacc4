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

//! A separate directory for every test, so tests can run in parallel.
class CommandLineTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  static std::string sample(const std::string& name) {
    return std::string(FLBC_MESHES_DIR) + "/" + name;
  }
  std::string file(const std::string& name, const std::string& content) const {
    std::ofstream(path(name)) << content;
    return path(name);
  }

  Ended run(const std::string& arguments) const {
    const auto out = path("stdout.txt");
    const auto err = path("stderr.txt");
    const std::string command =
        std::string(FLBC_PROGRAM) + " " + arguments + " >" + out + " 2>" + err + " </dev/null";
    const int status = std::system(command.c_str());
    Ended result{WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(out), slurp(err)};
    std::filesystem::remove(out);
    std::filesystem::remove(err);
    return result;
  }

  // Expects an exit status and words in the messages, and nothing on standard output but from
  // commands that are there to print.
  Ended expect(const std::string& arguments, int status = 0, const std::string& words = "") const {
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

  // Harmonic coordinates of a sample at its model (w.npy) and on a mesh (v.npy, domain_file).
  void solve(const std::string& name, const std::string& domain_file) const {
    const auto command = "solve " + sample(name + "_cage.obj") + " --method harmonic -q -o ";
    expect(command + path("w.npy") + " --vertices 1500 --save-domain " + path(domain_file) +
           " --model " + sample(name + "_model.obj"));
    expect(command + path("v.npy") + " --domain " + path(domain_file));
  }

  // A tetrahedron as cage, whose weights are known: x, y, z and what is left to 1.
  std::string tetrahedron(const std::string& vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n",
                          const std::string& name = "cage.obj") const {
    return file(name, vertices + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  }
  std::string linear_weights(const PointList<3>& points) const {
    WeightMatrix weights(4, points.cols());
    weights << 1 - points.colwise().sum().array(), points;
    io::write_weights(path("w.npy"), weights);
    return path("w.npy");
  }

 private:
  const ScratchFolder folder_;
};

}  // namespace flbc::testing
