// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The readers of the project as things to be fuzzed: by libFuzzer (fuzz_main.cpp) and, a little,
//! in every run of the tests (replay_test.cpp).
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/scratch.h"

namespace flbc::fuzz {

//! The result of a reader violates its contract. Not a flbc::Error, so that it counts as a finding.
class BrokenPromise : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

//! \throws BrokenPromise with these words unless it holds
inline void require(bool holds, const char* promise) {
  if (!holds) throw BrokenPromise(promise);
}

//! \throws BrokenPromise if a point of a mesh is not finite, or a vertex index of a cell is out of
//! range
template <class Mesh>
void require_indices_in_range(const Mesh& mesh) {
  require(mesh.points.allFinite(), "points are finite");
  for (const auto& cell : mesh.cells.colwise()) {
    for (const auto vertex : cell) {
      require(vertex >= 0 && vertex < mesh.num_vertices(), "vertices are in range");
    }
  }
}

//! A reader of files.
struct Reader {
  std::string name;  //!< for people
  std::string file;  //!< the file's name, by whose extension it is read
  //! Reads the file and requires of the result what users rely on. It may throw flbc::Error.
  void (*read)(const std::string& path);
  std::vector<std::string> seeds;  //!< contents that are read without an error
  //! Other files in the same directory: names with contents.
  std::vector<std::pair<std::string, std::string>> companions{};
  bool refuses =
      true;  //!< whether it refuses what it does not understand, rather than pass over it
};

//! The readers, one source file for each module.
std::vector<Reader> model_readers();
std::vector<Reader> mesh_readers();
std::vector<Reader> weight_readers();
std::vector<Reader> program_readers();

//! All of them.
std::vector<Reader> all_readers();

//! A temporary directory, in memory if possible.
struct Folder : testing::ScratchFolder {
  Folder();
  std::string path(const std::string& name) const {
    return (ScratchFolder::path() / name).string();
  }
};

//! Replaces a file. \throws std::runtime_error if it cannot be written
void put_file(const std::string& path, const char* bytes, std::size_t size);

//! The content of a file of this name that `write` has written.
template <class Write>
std::string written(const std::string& name, const Write& write) {
  const Folder folder;
  write(folder.path(name));
  return testing::slurp(folder.path(name));
}

//! A .npy file.
inline std::string npy(const std::string& dictionary, const std::string& numbers) {
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(dictionary.size()) + '\0' +
         dictionary + numbers;
}

//! Hands contents to one reader.
class Reading {
 public:
  explicit Reading(Reader reader);

  //! \return whether the content was read rather than refused
  //! \throws any exception except flbc::Error, as a finding
  bool accepts(const std::string& content) const;

 private:
  Reader reader_;
  Folder folder_;
  std::string path_;
};

}  // namespace flbc::fuzz
