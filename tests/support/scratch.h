// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Folders for the files of tests. Tests run side by side, so no two of them share a name.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <system_error>

namespace flbc::testing {

//! An empty folder of nobody else's, removed with all that is in it.
class ScratchFolder {
 public:
  //! \throws std::filesystem::filesystem_error if it cannot be made
  explicit ScratchFolder(
      const std::filesystem::path& parent = std::filesystem::temp_directory_path()) {
    std::random_device random;
    do {
      path_ = parent / ("flbc_test_" + std::to_string(random()));
    } while (!std::filesystem::create_directory(path_));  // false if it was there already
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

//! The whole content of a file; empty if there is none.
inline std::string slurp(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

//! The path of a file in a folder that this process has for itself.
inline std::string scratch_path(const std::string& name) {
  static const ScratchFolder folder;
  return (folder.path() / name).string();
}

}  // namespace flbc::testing
