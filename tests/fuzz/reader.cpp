// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/reader.h"

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>

#include "flbc/errors.h"

namespace flbc::fuzz {

Folder::Folder()
    : ScratchFolder(access("/dev/shm", W_OK) == 0 ? "/dev/shm"
                                                  : std::filesystem::temp_directory_path()) {
}

// Called millions of times, so no streams, and the file keeps its capacity.
void put_file(const std::string& path, const char* bytes, std::size_t size) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT, 0600);
  const bool done = file >= 0 && write(file, bytes, size) == static_cast<ssize_t>(size) &&
                    ftruncate(file, static_cast<off_t>(size)) == 0;
  if (file >= 0) close(file);
  if (!done) throw std::runtime_error("cannot write " + path);
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
