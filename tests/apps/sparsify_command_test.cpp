// SPDX-License-Identifier: BSD-3-Clause
// flbc sparsify as its users and their scripts see it.
#include "flbc/sparsify.h"
#include "support/command_line.h"
#include "support/model_cages.h"

namespace flbc::testing {
namespace {

class SparsifyCommand : public CommandLineTest {
 protected:
  void expect_refusal(const std::string& arguments, int status, const std::string& errors) const {
    expect_refused("sparsify " + arguments + " -o out.mtx", status, errors);
  }

  // A square with a model in it and weights that reproduce it.
  std::string square() const {
    file("cage.obj", "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nl 1 2 3 4 1\n");
    file("model.obj", "v 2 2 0\nv 1 2 0\n");
    file("w.csv", "0.25,0.25,0.25,0.25\n0.375,0.125,0.125,0.375\n");
    return "w.csv --cage cage.obj --points model.obj";
  }
};

TEST_F(SparsifyCommand, PoissonNeedsNeighbours) {
  const auto arguments = square();
  expect_refusal(arguments + " -k 3 --reduction poisson", 2,
                 "model.obj: has no faces and no lines");
  expect_refusal(arguments + " -k 3 --reduction cubic", 1, "choose from auto|poisson|quadratic");
  // Without neighbors there are no edges to measure.
  expect("sparsify " + arguments + " -k 3 -q -o s.npy --report r.json");
  const auto report = json_in("r.json");
  EXPECT_EQ(report["method"], "quadratic");
  EXPECT_FALSE(report["error"].contains("edge"));
  // A line is enough.
  file("model.obj", "v 2 2 0\nv 1 2 0\nl 1 2\n");
  EXPECT_EQ(run("sparsify " + arguments + " -k 3 -q --reduction poisson -o s.npy").errors, "");
}

TEST_F(SparsifyCommand, RefusesWhatCannotBe) {
  const auto arguments = square();
  expect_refusal(arguments, 1, "give -k");
  expect_refusal(arguments + " -k 2", 1, "at least 3 are needed");
  expect_refusal(arguments + " -k 3 --threshold 2", 1, "threshold");
  expect_refusal(arguments + " -k 3 --pose " + file("p.obj", "v 0 0 0\n"), 2,
                 "p.obj: has 1 vertices, but");
  expect_refusal("absent.npy --cage cage.obj --points model.obj -k 3", 4, "absent.npy");
  // Rows or columns that are not there.
  expect("sparsify " + arguments + " -k 3 -q -o s.npy");
  expect_refusal("s.npy --cage cage.obj --points cage.obj -k 3", 2,
                 "s.npy: has weights of 2 points, but");
  expect_refusal("s.npy --cage 2d/ring_cage.obj --points model.obj -k 3", 2,
                 "s.npy: has weights for 4 control points, but");
  file("model.obj", "v 2 2 0\nv 5 2 0\n");
  expect_refusal(arguments + " -k 3", 2, "model.obj: point 1 at (5, 2) lies outside");
  // No result may replace what is read.
  expect("sparsify s.npy --cage cage.obj --points model.obj -k 3 -o s.npy", 1);
}

}  // namespace
}  // namespace flbc::testing
