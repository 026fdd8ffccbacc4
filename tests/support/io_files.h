// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Files and expectations for the tests of the file layer.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "support/errors.h"
#include "support/scratch.h"

namespace flbc::testing {

//! A test with a separate empty directory.
class FolderTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  //! Makes a file. \return its path
  std::string make(const std::string& name, const std::string& content) const {
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
  }

  std::string content(const std::string& name) const { return slurp(path(name)); }

  //! The names in the folder, sorted; hidden ones included.
  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      result.push_back(entry.path().filename().string());
    }
    std::sort(result.begin(), result.end());
    return result;
  }

 private:
  const ScratchFolder scratch_;

 protected:
  const std::filesystem::path& folder_ = scratch_.path();
};

inline std::uint64_t bits_of(double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

//! True if two matrices have the same size and bits.
template <class A, class B>
::testing::AssertionResult bit_equal(const A& a, const B& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) {
    return ::testing::AssertionFailure()
           << a.rows() << " x " << a.cols() << " is not " << b.rows() << " x " << b.cols();
  }
  for (int j = 0; j < a.cols(); ++j) {
    for (int i = 0; i < a.rows(); ++i) {
      if (bits_of(a(i, j)) == bits_of(b(i, j))) continue;
      return ::testing::AssertionFailure()
             << "element " << i << ", " << j << " differs: " << a(i, j) << " and " << b(i, j);
    }
  }
  return ::testing::AssertionSuccess();
}

//! Numbers that are hard to print: the doubles are finite and none is -0.
inline std::vector<double> awkward_numbers() {
  return {1.0 / 3.0,
          -2.0 / 3.0,
          0.1,
          1e-300,
          -1e300,
          4.9406564584124654e-324,   // the least denormal
          -2.2250738585072009e-308,  // the largest denormal, negated
          1.7976931348623157e308,    // the largest double
          0.0,
          1.0,
          1.0000000000000002,
          123456789012345680.0,
          9007199254740993.0,
          5e-5};
}

}  // namespace flbc::testing
