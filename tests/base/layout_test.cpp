// SPDX-License-Identifier: BSD-3-Clause
// Rules of the source tree that neither the compiler nor CMake checks.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = FLBC_SOURCE_DIR;

std::vector<fs::path> files_in(const fs::path& folder, const std::set<std::string>& extensions) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (extensions.count(entry.path().extension().string()) > 0) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream in(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// Tests run in parallel, so two of them could write the same file.
TEST(Layout, TestsWriteInFoldersOfTheirOwn) {
  static const std::regex shared(R"(TempDir\(|temp_directory_path\(|"/tmp)");
  // The first two create such folders; this file only names the functions.
  const std::set<std::string> makers{"scratch.h", "reader.cpp", "layout_test.cpp"};
  for (const auto& file : files_in(kRoot / "tests", {".h", ".cpp"})) {
    if (makers.count(file.filename().string()) > 0) continue;
    for (const auto& line : lines_of(file)) {
      EXPECT_FALSE(std::regex_search(line, shared)) << file << ": " << line;
    }
  }
}

// Callers of the library have no command line; the program puts its options into messages
// (apps/help/wording.h).
TEST(Layout, LibrariesNameNoOptionsOfTheProgram) {
  static const std::regex option(R"("[^"]*(--[a-z]|\bflbc [a-z]+ ?)[^"]*")");
  int lines = 0;
  for (const char* folder : {"libflbc", "openmesh_bindings/src", "openmesh_bindings/include"}) {
    for (const auto& file : files_in(kRoot / folder, {".h", ".cpp", ".inl"})) {
      for (const auto& line : lines_of(file)) {
        ++lines;
        EXPECT_FALSE(std::regex_search(line, option)) << file << ": " << line;
      }
    }
  }
  EXPECT_GT(lines, 10000);
}

// One definition rule: if two classes share a name, the linker picks the functions of either one.
TEST(Layout, ClassesAreDefinedOnce) {
  static const std::regex name_of_namespace(R"(^namespace ([a-z0-9_:]+) \{)");
  static const std::regex name_of_class(
      R"(^(?:class|struct) (?:\w+\(.*?\) )?(\w+)(?: final)?(?: : .*)? \{)");
  std::map<std::string, fs::path> defined_in;
  for (const char* folder :
       {"libflbc", "apps", "openmesh_bindings/src", "openmesh_bindings/include"}) {
    for (const auto& file : files_in(kRoot / folder, {".h", ".cpp", ".inl"})) {
      std::string where;
      bool is_local = false;
      std::smatch match;
      for (const auto& line : lines_of(file)) {
        if (line == "namespace {") is_local = true;
        if (line == "}  // namespace") is_local = false;
        if (std::regex_search(line, match, name_of_namespace)) where = match[1];
        if (is_local || !std::regex_search(line, match, name_of_class)) continue;
        const auto [entry, is_new] = defined_in.emplace(where + "::" + match[1].str(), file);
        EXPECT_TRUE(is_new) << entry->first << " is defined in " << entry->second << " and "
                            << file;
      }
    }
  }
  EXPECT_EQ(defined_in.count("flbc::LbcProblem"), 1u);  // the patterns match
}

}  // namespace
