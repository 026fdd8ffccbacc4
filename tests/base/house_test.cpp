// SPDX-License-Identifier: BSD-3-Clause
// The house stands as docs/architecture.md says: includes never run up a floor, every public header
// that declares functions has one source of its name, and files and functions stay small.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = FLBC_SOURCE_DIR;
const fs::path kSources = kRoot / "libflbc/src";
const fs::path kHeaders = kRoot / "libflbc/include/flbc";

// The floors, lowest first; rooms on one floor may include each other.
const std::vector<std::vector<std::string>> kFloors{{"base"},
                                                    {"linear", "mesh"},
                                                    {"cage"},
                                                    {"problem", "meshing", "projection", "caging"},
                                                    {"coordinates", "certificate", "sparsify"},
                                                    {"solver", "evaluation"}};

// Public headers of types, which have no source, and those that only include others.
const std::map<std::string, std::string> kRoomsOfTypes{
    {"types", "base"},          {"byte_archive", "base"}, {"errors", "base"},        {"content_hash", "base"},
    {"version", "base"},       {"padded_rows", "base"},   {"boundary_tolerance", "base"},
    {"linear_solver", "linear"}, {"cell_field", "mesh"},    {"meshing_options", "meshing"},
    {"report", "solver"},       {"solver_state", "solver"}, {"coarse_to_fine", "solver"}, {"meshing", "meshing"},
    {"coordinates", "coordinates"}, {"flbc", "evaluation"}};

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

int floor_of(const std::string& room) {
  for (std::size_t floor = 0; floor < kFloors.size(); ++floor) {
    const auto& rooms = kFloors[floor];
    if (std::find(rooms.begin(), rooms.end(), room) != rooms.end()) return static_cast<int>(floor);
  }
  return -1;
}

std::string room_of_source(const fs::path& path) {
  return fs::relative(path, kSources).begin()->string();
}

// The room of a public header is that of the source of its name.
std::map<std::string, std::vector<std::string>> rooms_of_headers() {
  std::map<std::string, std::vector<std::string>> rooms;
  for (const auto& source : files_in(kSources, {".cpp"})) {
    if (fs::exists(kHeaders / (source.stem().string() + ".h"))) {
      rooms[source.stem().string()].push_back(room_of_source(source));
    }
  }
  for (const auto& [header, room] : kRoomsOfTypes) rooms[header].push_back(room);
  return rooms;
}

// The line without strings, characters and comments, whose braces are no code.
std::string code_of(const std::string& line) {
  static const std::regex literal(R"("(\\.|[^"\\])*"|'(\\.|[^'\\])*'|//.*)");
  return std::regex_replace(line, literal, "");
}

// First line and number of lines of each function's body. A body is opened by a line that ends a
// signature, and is no branch, loop or lambda.
std::vector<std::pair<std::size_t, std::size_t>> function_bodies(
    const std::vector<std::string>& lines) {
  static const std::regex signature(
      R"(\)( const| noexcept| override)*( ->.*| : .*)? \{$)");
  static const std::regex other(R"(^ *(\} else |if |for |while |switch |\} catch )|\[[^\]]*\] ?[({])");
  std::vector<std::pair<std::size_t, std::size_t>> bodies;
  std::vector<std::pair<bool, std::size_t>> open;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const std::string code = code_of(lines[k]);
    const bool opens_function =
        std::regex_search(code, signature) && !std::regex_search(code, other);
    for (const char c : code) {
      if (c == '{') open.push_back({opens_function, k + 1});
      if (c != '}' || open.empty()) continue;
      if (open.back().first && k > open.back().second) bodies.push_back({open.back().second, k - open.back().second});
      open.pop_back();
    }
  }
  return bodies;
}

TEST(House, IncludesNeverRunUpAFloor) {
  const auto header_rooms = rooms_of_headers();
  const std::regex include("^#include \"([a-z_]+)/([a-z_/0-9]+)\\.(h|inl)\"");
  auto files = files_in(kSources, {".h", ".cpp", ".inl"});
  for (const auto& header : files_in(kHeaders, {".h"})) files.push_back(header);
  for (const auto& file : files) {
    const bool is_public = file.parent_path() == kHeaders;
    const std::string name = file.stem().string();
    if (is_public) {
      ASSERT_EQ(header_rooms.count(name), 1u) << name << ".h belongs to no room";
    }
    const std::string room = is_public ? header_rooms.at(name).front() : room_of_source(file);
    ASSERT_GE(floor_of(room), 0) << file;
    for (const auto& line : lines_of(file)) {
      std::smatch found;
      if (!std::regex_search(line, found, include)) continue;
      const std::string folder = found[1], included = found[2];
      std::string target = folder;
      if (folder == "flbc") {
        EXPECT_NE(included.substr(0, 3), "io/") << file << ": the core knows no file formats";
        ASSERT_EQ(header_rooms.count(included), 1u) << file << ": " << line;
        target = header_rooms.at(included).front();
      }
      ASSERT_GE(floor_of(target), 0) << file << ": " << line;
      EXPECT_LE(floor_of(target), floor_of(room)) << file << " runs up a floor: " << line;
    }
  }
}

TEST(House, PublicHeadersHaveOneSourceOfTheirName) {
  const auto rooms = rooms_of_headers();
  for (const auto& header : files_in(kHeaders, {".h"})) {
    const std::string name = header.stem().string();
    ASSERT_EQ(rooms.count(name), 1u) << name << ".h has no source of its name";
    EXPECT_EQ(rooms.at(name).size(), 1u) << name << ".h has several";
  }
}

TEST(House, OnlyRoomsStandInTheSources) {
  for (const auto& entry : fs::directory_iterator(kSources)) {
    EXPECT_TRUE(entry.is_directory()) << entry.path() << " belongs in a room";
    EXPECT_GE(floor_of(entry.path().filename().string()), 0) << entry.path();
  }
}

TEST(House, SourcesAndFunctionsAreSmall) {
  std::vector<fs::path> files;
  for (const char* folder : {"libflbc", "apps", "openmesh_bindings"}) {
    for (const auto& file : files_in(kRoot / folder, {".h", ".cpp", ".inl"})) files.push_back(file);
  }
  for (const auto& file : files) {
    const auto lines = lines_of(file);
    EXPECT_LE(lines.size(), 300u) << file;
    for (const auto& [begin, length] : function_bodies(lines)) {
      EXPECT_LE(length, 50u) << file << ":" << begin;
    }
  }
}

// Tests run side by side: files of one name would be written by two of them at once.
TEST(House, TestsWriteInFoldersOfTheirOwn) {
  static const std::regex shared(R"(TempDir\(|temp_directory_path\(|"/tmp)");
  // These make such folders, and this names what makes none.
  const std::set<std::string> makers{"scratch.h", "reader.cpp", "house_test.cpp"};
  for (const auto& file : files_in(kRoot / "tests", {".h", ".cpp"})) {
    if (makers.count(file.filename().string()) > 0) continue;
    for (const auto& line : lines_of(file)) {
      EXPECT_FALSE(std::regex_search(line, shared)) << file << ": " << line;
    }
  }
}

// Two classes of one name in a namespace are one to the linker, which takes either's functions.
TEST(House, ClassesAreDefinedOnce) {
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
  EXPECT_EQ(defined_in.count("flbc::LbcProblem"), 1u);  // such are found
}

}  // namespace
