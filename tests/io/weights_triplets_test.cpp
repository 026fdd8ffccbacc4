// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/weights_triplets.h"

#include <fstream>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "flbc/errors.h"
#include "support/io_files.h"
#include "support/scratch.h"

namespace flbc::testing {
namespace {

std::string file(const std::string& content) {
  const auto path = scratch_path("triplets.txt");
  std::ofstream(path) << content;
  return path;
}

void expect_refusal(const std::string& content, const std::string& text) {
  const auto path = file(content);
  expect_error<InputError>([&] { io::read_weight_triplets(path, 2, 3).dense(); }, {path, text});
}

TEST(Triplets, AreReadInAnyOrder) {
  WeightMatrix expected = WeightMatrix::Zero(2, 3);
  expected << 0.25, 0, 1, 0.75, 1, -2e-3;
  const auto path = file("# of another program\n1 2 -2e-3\n1 0 0.75\r\n\n0 0 0.25\n0 2 1\n1 1 1");
  EXPECT_EQ(io::read_weight_triplets(path, 2, 3).dense(), expected);
}

TEST(Triplets, DefectsAreNamed) {
  expect_refusal("0 0 1\n2 0 1\n", ":2: ");
  expect_refusal("0 3 1\n", ":1: ");
  expect_refusal("0 0 1\n0 1\n", ":2: ");
  expect_refusal("0 0 nan\n", ":1: ");
  expect_refusal("0 0 1 7\n", ":1: ");
  expect_refusal("0 0 1\n1 0 1\n0 0 1\n", ":3: the weight of control point 0 at point 0");
  expect_refusal("0 2 1\n", "weights for 1 control points, but there are 2");
  expect_refusal("1 0 1\n", "weights for 1 points, but there are 3");
  expect_refusal("", "weights for 0 control points");
  EXPECT_THROW(io::read_weight_triplets("/absent/w.txt", 2, 3).dense(), IoError);
}

WeightMatrix awkward_triplets() {
  const auto numbers = awkward_numbers();
  WeightMatrix weights = WeightMatrix::Zero(5, static_cast<Eigen::Index>(numbers.size()));
  for (Eigen::Index v = 0; v < weights.cols() - 1; ++v) weights(v % 4, v) = numbers[v];
  return weights;  // the last row and the last column are 0
}

TEST(Triplets, AreReadBackBitByBit) {
  const auto weights = awkward_triplets();
  const auto path = file("");
  io::write_weight_triplets(path, weights);
  EXPECT_TRUE(bit_equal(io::read_weight_triplets(path, 5, 14).dense(), weights));
  EXPECT_TRUE(bit_equal(io::read_weight_triplets(path).dense(), weights));
}

TEST(Triplets, TellTheirSizeByTheLargestNumbers) {
  const auto path = file("3 0 0.5\n0 6 0.25\n");
  const auto weights = io::read_weight_triplets(path).dense();
  WeightMatrix expected = WeightMatrix::Zero(4, 7);
  expected(3, 0) = 0.5;
  expected(0, 6) = 0.25;
  EXPECT_EQ(weights, expected);
  const auto refuse = [&](const std::string& content, const std::string& text) {
    const auto name = file(content);
    expect_error<InputError>([&] { io::read_weight_triplets(name).dense(); }, {name, text});
  };
  refuse("0 0 1\n0 2000000000 1\n",
         "the largest indices imply 1 control points and 2000000001 points, but there are only 2");
  refuse("0 0 1\n0 2000000 1\n", "but there are only 2 weights");
  refuse("# nothing\n", "has no weights");
  refuse("0 0 1\n-1 0 1\n", ":2: ");
}

TEST(Triplets, WhatCannotBeReadBackIsNotWritten) {
  const auto path = file("as it was");
  WeightMatrix weights = WeightMatrix::Ones(2, 2);
  weights(1, 0) = std::numeric_limits<double>::infinity();
  expect_error<InputError>([&] { io::write_weight_triplets(path, weights); },
                           {"the weight of control point 1 at point 0 is not finite"});
  expect_error<InputError>([&] { io::write_weight_triplets(path, WeightMatrix(3, 0)); },
                           {path, "there are no weights"});
  std::ifstream before(path);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(before), {}), "as it was");
  EXPECT_THROW(io::write_weight_triplets("/absent/w.txt", WeightMatrix::Ones(1, 1)), IoError);
}

}  // namespace
}  // namespace flbc::testing
