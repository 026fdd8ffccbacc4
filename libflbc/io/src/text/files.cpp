// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/files.h"

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#endif

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <random>
#include <system_error>

#include "flbc/errors.h"
#include "text/text_reader.h"

namespace flbc::io {
namespace {

namespace fs = std::filesystem;

using FileHandle = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

[[noreturn]] void fail(const char* action, const std::string& path, const std::string& reason) {
  throw IoError(std::string("cannot ") + action +
                (path == "-" ? " standard " + std::string(action[0] == 'r' ? "input" : "output")
                             : " \"" + path + "\"") +
                ": " + reason);
}

// `error` is an errno; 0 if unknown.
std::string reason_of(int error) {
  return error == 0 ? "unknown reason" : std::generic_category().message(error);
}

// Resolves symbolic links, including links to missing files, because renaming onto a link would
// replace the link instead of its target.
fs::path resolve_links(fs::path path) {
  constexpr int kMaxLinks = 40;
  std::error_code ignored;
  for (int i = 0; i < kMaxLinks && fs::is_symlink(path, ignored); ++i) {
    const fs::path target = fs::read_symlink(path, ignored);
    path = target.is_absolute() ? target : path.parent_path() / target;
  }
  return path;
}

// Makes an empty file. Fails if there is one, so that names of several programs do not collide.
// Unlike mkstemp() it gives default permissions.
bool create_exclusively(const fs::path& path) {
#ifdef _WIN32  // whose fopen() does not have "x"
  const int file = _wopen(path.c_str(), _O_CREAT | _O_EXCL | _O_WRONLY, _S_IREAD | _S_IWRITE);
  return file >= 0 && _close(file) == 0;
#else
  return FileHandle(std::fopen(path.c_str(), "wbx"), &std::fclose) != nullptr;
#endif
}

// A new empty file that is removed unless it is renamed.
class TemporaryFile {
 public:
  TemporaryFile(const fs::path& folder, const std::string& final_path) {
    // The name does not contain the final name, which may already have the maximum length.
    constexpr int kMaxAttempts = 100;
    std::random_device random;
    for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
      char name[32];
      std::snprintf(name, sizeof name, ".flbc-%08x.tmp", static_cast<unsigned>(random()));
      path_ = folder / name;
      errno = 0;
      if (create_exclusively(path_)) return;
      if (errno != EEXIST) break;
    }
    fail("write", final_path, reason_of(errno));
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove(path_, ignored);
  }

  const fs::path& path() const { return path_; }

  void rename_to(const fs::path& target, const std::string& final_path) {
    std::error_code error;
    fs::rename(path_, target, error);
    if (error) fail("write", final_path, error.message());
    path_.clear();
  }

 private:
  fs::path path_;
};

// A full disk is reported only by flush and close.
void fill_file(const fs::path& target, const std::string& path,
               const std::function<void(std::ostream&)>& write) {
  errno = 0;
  std::ofstream out(target, std::ios::binary);
  if (!out) fail("write", path, reason_of(errno));
  errno = 0;
  write(out);
  out.flush();
  out.close();
  if (!out) fail("write", path, reason_of(errno));
}

void write_standard_output(const std::function<void(std::ostream&)>& write) {
  // A separate stream, so formatting flags set by `write` do not persist.
  std::ostream out(std::cout.rdbuf());
  errno = 0;
  write(out);
  out.flush();
  if (!out) fail("write", "-", reason_of(errno));
}

std::size_t size_hint(const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  return error ? 0 : static_cast<std::size_t>(size);
}

}  // namespace

std::string read_file(const std::string& path) {
  errno = 0;
  const FileHandle opened(path == "-" ? nullptr : std::fopen(path.c_str(), "rb"), &std::fclose);
  std::FILE* const file = path == "-" ? stdin : opened.get();
  if (!file) {
    const int error = errno;
    std::error_code ignored;  // of folders, Windows says that permission is denied
    fail("read", path, reason_of(fs::is_directory(path, ignored) ? EISDIR : error));
  }

  // The length is only a hint, because a pipe has none; one extra byte detects the end immediately.
  const std::size_t room = path == "-" ? 0 : size_hint(path) + 1;
  std::string content;
  for (;;) {
    const std::size_t used = content.size();
    content.resize(std::max({room, 2 * used, std::size_t{1} << 12}));
    errno = 0;
    const std::size_t got = std::fread(content.data() + used, 1, content.size() - used, file);
    content.resize(used + got);
    if (std::ferror(file)) fail("read", path, reason_of(errno));
    if (std::feof(file)) return content;
  }
}

void write_file(const std::string& path, const std::function<void(std::ostream&)>& write) {
  if (path == "-") return write_standard_output(write);
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) fail("write", path, reason_of(EISDIR));
  // Devices and pipes cannot be replaced by renaming, so they are written directly. Links to pipes
  // (such as /dev/stdout) have no target path, so they must not be resolved.
  if (fs::exists(status) && !fs::is_regular_file(status)) return fill_file(path, path, write);
  // Renaming would replace even a write-protected file; opening it for appending checks permission
  // without changes.
  const fs::path target = resolve_links(path);
  errno = 0;
  if (fs::exists(status) && !std::ofstream(target, std::ios::app)) {
    fail("write", path, reason_of(errno));
  }

  TemporaryFile temporary(target.parent_path(), path);
  fill_file(temporary.path(), path, write);
  // Overwriting a file preserves its permissions.
  if (fs::exists(status)) fs::permissions(temporary.path(), status.permissions(), error);
  temporary.rename_to(target, path);
}

std::string extension_of(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  return lower_case(extension);
}

}  // namespace flbc::io
