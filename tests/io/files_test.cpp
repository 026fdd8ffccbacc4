// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/files.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <iostream>
#include <ostream>
#include <stdexcept>
#include <thread>

#include "support/io_files.h"

namespace flbc::io {
namespace {

using flbc::testing::expect_error;
using flbc::testing::FolderTest;
using Names = std::vector<std::string>;

using FilesTest = FolderTest;

void write_text(const std::string& path, const std::string& text) {
  write_file(path, [&](std::ostream& out) { out << text; });
}

mode_t permissions_of(const std::string& path) {
  struct stat status {};
  EXPECT_EQ(stat(path.c_str(), &status), 0);
  return status.st_mode & 0777;
}

// Goes back to the old folder at the end of a scope.
class WorkingFolder {
 public:
  explicit WorkingFolder(const std::filesystem::path& folder)
      : previous_(std::filesystem::current_path()) {
    std::filesystem::current_path(folder);
  }
  ~WorkingFolder() { std::filesystem::current_path(previous_); }

 private:
  std::filesystem::path previous_;
};

// While it lives, files cannot grow beyond `bytes`: a disk that runs full.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : previous_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &previous_);
    const rlimit limited{bytes, previous_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limited);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &previous_);
    std::signal(SIGXFSZ, previous_handler_);
  }

 private:
  void (*previous_handler_)(int);
  rlimit previous_{};
};

TEST_F(FilesTest, WhatIsWrittenIsReadBack) {
  const WorkingFolder here(folder_);
  const std::string bytes("a\0b\r\n\xff\x1a", 7);
  for (const std::string& name : {path("a.bin"), std::string("b.bin"), std::string("./c.bin")}) {
    write_text(name, bytes);
    EXPECT_EQ(read_file(name), bytes);
  }
  EXPECT_EQ(names(), (Names{"a.bin", "b.bin", "c.bin"}));
}

TEST_F(FilesTest, ReadsPipes) {
  const std::string pipe = path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  // Either side waits until the other one opens.
  const std::string text(300000, 'y');
  std::thread writer([&] { std::ofstream(pipe) << text; });
  const std::string got = read_file(pipe);
  writer.join();
  EXPECT_EQ(got, text);
}

TEST_F(FilesTest, ReadingNamesFileAndReason) {
  expect_error<IoError>([&] { read_file(path("missing")); },
                        {"cannot read", path("missing"), "No such file or directory"});
  expect_error<IoError>([&] { read_file(folder_.string()); },
                        {"cannot read", folder_.string(), "Is a directory"});
  expect_error<IoError>([&] { read_file(""); }, {"cannot read \"\""});
}

TEST_F(FilesTest, NewFilesHaveOrdinaryPermissionsAndOldOnesKeepTheirs) {
  const mode_t previous = umask(027);
  write_text(path("new"), "x");
  umask(previous);
  EXPECT_EQ(permissions_of(path("new")), mode_t{0640});
  ASSERT_EQ(chmod(path("new").c_str(), 0604), 0);
  write_text(path("new"), "y");
  EXPECT_EQ(content("new"), "y");
  EXPECT_EQ(permissions_of(path("new")), mode_t{0604});
  EXPECT_EQ(names(), Names{"new"});
}

TEST_F(FilesTest, FollowsLinks) {
  std::filesystem::create_directory(folder_ / "sub");
  make("sub/target", "old");
  std::filesystem::create_symlink("sub/target", folder_ / "link");
  std::filesystem::create_symlink("sub/new", folder_ / "dangling");
  write_text(path("link"), "linked");
  write_text(path("dangling"), "created");
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "link"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "dangling"));
  EXPECT_EQ(content("sub/target"), "linked");
  EXPECT_EQ(content("sub/new"), "created");
  EXPECT_EQ(names(), (Names{"dangling", "link", "sub"}));
}

TEST_F(FilesTest, AnExceptionLeavesNoTrace) {
  make("kept", "old");
  const auto fail = [](std::ostream& out) {
    out << "half" << std::flush;
    throw std::runtime_error("stopped in the middle");
  };
  for (const char* name : {"kept", "fresh"}) {
    expect_error<std::runtime_error>([&] { write_file(path(name), fail); },
                                     {"stopped in the middle"});
  }
  EXPECT_EQ(content("kept"), "old");
  EXPECT_EQ(names(), Names{"kept"});
}

TEST_F(FilesTest, TheFileAppearsOnlyWhenItIsComplete) {
  make("kept", "old");
  write_file(path("kept"), [&](std::ostream& out) {
    out << "new" << std::flush;
    EXPECT_EQ(content("kept"), "old");
  });
  EXPECT_EQ(content("kept"), "new");
}

TEST_F(FilesTest, AFullDiskLeavesNoTrace) {
  make("kept", "old");
  for (const std::size_t size : {5000, 5000000}) {
    for (const char* name : {"kept", "fresh"}) {
      const auto write_too_much = [&] {
        // Small pieces stay in the stream's buffer, so the failure may come as late as the flush.
        const FileSizeLimit limit(4096);
        write_file(path(name), [&](std::ostream& out) {
          for (std::size_t k = 0; k < size; ++k) out << 'x';
        });
      };
      expect_error<IoError>(write_too_much, {"cannot write", path(name), "File too large"});
    }
  }
  EXPECT_EQ(content("kept"), "old");
  EXPECT_EQ(names(), Names{"kept"});
}

TEST_F(FilesTest, AFullDeviceIsAnErrorAndStaysADevice) {
  if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  expect_error<IoError>([] { write_text("/dev/full", "x"); },
                        {"cannot write \"/dev/full\"", "No space left on device"});
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
  write_text("/dev/null", "x");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(FilesTest, WritingNamesFileAndReason) {
  expect_error<IoError>([&] { write_text(path("missing/file"), "x"); },
                        {"cannot write", path("missing/file"), "No such file or directory"});
  expect_error<IoError>([&] { write_text(folder_.string(), "x"); },
                        {"cannot write", folder_.string(), "Is a directory"});
  make("file", "x");
  expect_error<IoError>([&] { write_text(path("file/below"), "x"); },
                        {"cannot write", path("file/below"), "Not a directory"});
  expect_error<IoError>([&] { write_text("", "x"); }, {"cannot write \"\""});
  EXPECT_EQ(names(), Names{"file"});
}

TEST_F(FilesTest, ProtectedFoldersAndFilesStay) {
  if (geteuid() == 0) GTEST_SKIP() << "nothing is protected from the superuser";
  const std::string file = make("kept", "old");
  ASSERT_EQ(chmod(file.c_str(), 0444), 0);
  expect_error<IoError>([&] { write_text(file, "new"); }, {file, "Permission denied"});
  EXPECT_EQ(content("kept"), "old");
  ASSERT_EQ(chmod(folder_.c_str(), 0555), 0);
  expect_error<IoError>([&] { write_text(path("new"), "x"); }, {path("new"), "Permission denied"});
  ASSERT_EQ(chmod(folder_.c_str(), 0755), 0);
  EXPECT_EQ(names(), Names{"kept"});
}

TEST_F(FilesTest, DashIsStandardOutput) {
  const WorkingFolder here(folder_);
  ::testing::internal::CaptureStdout();
  write_file("-", [](std::ostream& out) { out << std::hex << 255 << "\n"; });
  std::cout << 255 << std::flush;  // the flags of `write` are gone
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "ff\n255");
  EXPECT_TRUE(names().empty());
}

TEST(ExtensionOf, IsInLowerCaseWithoutDot) {
  EXPECT_EQ(extension_of("a.OBJ"), "obj");
  EXPECT_EQ(extension_of("folder.d/a.tar.Gz"), "gz");
  EXPECT_EQ(extension_of("folder.d/a"), "");
  EXPECT_EQ(extension_of(".hidden"), "");
  EXPECT_EQ(extension_of("a."), "");
  EXPECT_EQ(extension_of("-"), "");
  EXPECT_EQ(extension_of(""), "");
}

}  // namespace
}  // namespace flbc::io
