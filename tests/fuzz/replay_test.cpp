// SPDX-License-Identifier: BSD-3-Clause
// Every reader reads its seeds, and neither inputs that once broke something nor damaged seeds make
// it do anything but read or refuse. libFuzzer does this for longer (scripts/fuzz.sh).
#include <algorithm>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "fuzz/reader.h"

namespace flbc::testing {
namespace {

namespace fs = std::filesystem;
using fuzz::Reader;
using fuzz::Reading;

constexpr int kDamages = 3000;

// The content with one to four damages: a byte changed, a piece removed or repeated, the end lost.
std::string damaged(std::string content, std::mt19937& random) {
  const auto below = [&](std::size_t limit) { return limit == 0 ? 0 : random() % limit; };
  static const std::vector<std::string> words{"-1",  "0",  "4294967296", "1e999",
                                              "nan", "\n", " ",          "/"};
  for (auto times = 1 + below(4); times > 0 && !content.empty(); --times) {
    const auto begin = below(content.size());
    const auto length = 1 + below(std::min<std::size_t>(16, content.size() - begin));
    switch (below(6)) {
      case 0:
        content[begin] = static_cast<char>(random());
        break;
      case 1:
        content.erase(begin, length);
        break;
      case 2:
        content.insert(begin, content.substr(begin, length));
        break;
      case 3:
        content.replace(begin, length, words[below(words.size())]);
        break;
      case 4:
        std::swap(content[begin], content[below(content.size())]);
        break;
      default:
        content.resize(begin);
    }
  }
  return content;
}

class FuzzReplay : public ::testing::TestWithParam<Reader> {
 protected:
  // Whether it is read; a failure if it is neither read nor refused.
  bool accepts(const std::string& content) {
    try {
      return reading_.accepts(content);
    } catch (const std::exception& error) {
      ADD_FAILURE() << "neither read nor refused: " << error.what() << " with the content\n"
                    << ::testing::PrintToString(content);
    }
    return false;
  }

  Reading reading_{GetParam()};
};

TEST_P(FuzzReplay, ReadsItsSeeds) {
  ASSERT_FALSE(GetParam().seeds.empty());
  for (const auto& seed : GetParam().seeds) {
    EXPECT_TRUE(accepts(seed)) << ::testing::PrintToString(seed);
  }
}

TEST_P(FuzzReplay, ReadsOrRefusesWhatWasFound) {
  const auto folder = fs::path(FLBC_SOURCE_DIR) / "tests/fuzz/found" / GetParam().name;
  if (!fs::exists(folder)) return;
  for (const auto& entry : fs::directory_iterator(folder)) {
    SCOPED_TRACE(entry.path());
    accepts(slurp(entry.path()));
  }
}

TEST_P(FuzzReplay, ReadsOrRefusesDamagedSeeds) {
  std::mt19937 random(7);
  int refused = 0;
  for (int k = 0; k < kDamages && !HasFailure(); ++k) {
    const auto& seeds = GetParam().seeds;
    if (!accepts(damaged(seeds[random() % seeds.size()], random))) ++refused;
  }
  EXPECT_EQ(refused > 0, GetParam().refuses);
}

INSTANTIATE_TEST_SUITE_P(Readers, FuzzReplay, ::testing::ValuesIn(fuzz::all_readers()),
                         [](const auto& reader) { return reader.param.name; });

TEST(FuzzNet, ABrokenPromiseIsAFinding) {
  const Reading reading(
      {"careless",
       "a.txt",
       [](const std::string& path) { fuzz::require(slurp(path) == "good", "files are good"); },
       {}});
  EXPECT_TRUE(reading.accepts("good"));
  EXPECT_THROW(reading.accepts("bad"), fuzz::BrokenPromise);
}

}  // namespace
}  // namespace flbc::testing
