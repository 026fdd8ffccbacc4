// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/weights_triplets.h"

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "flbc/errors.h"
#include "support/io_files.h"

namespace flbc::testing {
namespace {

// A file for every test, so that tests may run side by side.
std::string file(const std::string& content) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto path = ::testing::TempDir() + "/flbc_triplets_" + test->name() + ".txt";
  std::ofstream(path) << content;
  return path;
}

void expect_refusal(const std::string& content, const std::string& text) {
  const auto path = file(content);
  expect_error<InputError>([&] { io::read_weight_triplets(path, 2, 3); }, {path, text});
}

TEST(Triplets, AreReadInAnyOrder) {
  WeightMatrix expected = WeightMatrix::Zero(2, 3);
  expected << 0.25, 0, 1, 0.75, 1, -2e-3;
  const auto path = file("# of another program\n1 2 -2e-3\n1 0 0.75\r\n\n0 0 0.25\n0 2 1\n1 1 1");
  EXPECT_EQ(io::read_weight_triplets(path, 2, 3), expected);
}

TEST(Triplets, DefectsAreNamed) {
  expect_refusal("0 0 1\n2 0 1\n", ":2: ");
  expect_refusal("0 3 1\n", ":1: ");
  expect_refusal("0 0 1\n0 1\n", ":2: ");
  expect_refusal("0 0 nan\n", ":1: ");
  expect_refusal("0 0 1 7\n", ":1: ");
  expect_refusal("0 0 1\n1 0 1\n0 0 1\n", ":3: the weight of control point 0 at point 0");
  expect_refusal("0 2 1\n", "weights for 1 control points, but 2 are there");
  expect_refusal("1 0 1\n", "weights for 1 points, but 3 are there");
  expect_refusal("", "weights for 0 control points");
  EXPECT_THROW(io::read_weight_triplets("/absent/w.txt", 2, 3), IoError);
}

}  // namespace
}  // namespace flbc::testing
