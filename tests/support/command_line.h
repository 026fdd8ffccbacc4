// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Runs the program FLBC_PROGRAM as its users do.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

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

//! A folder of its own for every test, so that tests may run side by side.
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

 private:
  const ScratchFolder folder_;
};

}  // namespace flbc::testing
