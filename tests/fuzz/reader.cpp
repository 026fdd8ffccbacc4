// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/reader.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "flbc/errors.h"

namespace flbc::fuzz {
namespace {

namespace fs = std::filesystem;

fs::path folder_for_folders() {
  const fs::path in_memory = "/dev/shm";
  return access(in_memory.c_str(), W_OK) == 0 ? in_memory : fs::temp_directory_path();
}

}  // namespace

Folder::Folder() {
  std::string name = (folder_for_folders() / "flbc_fuzz_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a folder");
  path_ = name;
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string Folder::path(const std::string& name) const {
  return path_ + "/" + name;
}

// Called millions of times, so no streams, and the file keeps its capacity.
void put_file(const std::string& path, const char* bytes, std::size_t size) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT, 0600);
  const bool done = file >= 0 && write(file, bytes, size) == static_cast<ssize_t>(size) &&
                    ftruncate(file, static_cast<off_t>(size)) == 0;
  if (file >= 0) close(file);
  if (!done) throw std::runtime_error("cannot write " + path);
}

std::string get_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<Reader> all_readers() {
  std::vector<Reader> all;
  for (const auto& some : {model_readers(), mesh_readers(), weight_readers(), program_readers()}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

Reading::Reading(Reader reader) : reader_(std::move(reader)), path_(folder_.path(reader_.file)) {
  for (const auto& [name, content] : reader_.companions) {
    put_file(folder_.path(name), content.data(), content.size());
  }
}

bool Reading::accepts(const std::string& content) const {
  put_file(path_, content.data(), content.size());
  try {
    reader_.read(path_);
  } catch (const Error&) {
    return false;
  }
  return true;
}

}  // namespace flbc::fuzz
