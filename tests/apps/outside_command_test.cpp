// SPDX-License-Identifier: BSD-3-Clause
// Models that extend outside their cage, slightly or more, from the view of a user.
#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include "flbc/io/weights_io.h"
#include "support/command_line.h"

namespace flbc::testing {
namespace {

class OutsideCommand : public CommandLineTest {
 protected:
  std::string square() const {
    return file("square.obj", "v 0 0\nv 1 0\nv 1 1\nv 0 1\nl 1 2 3 4 1\n");
  }
  // A triangle, two of whose corners are outside by so much.
  std::string model(const std::string& distance) const {
    return file("model.obj",
                "v 0.5 0.5 0\nv 0.3 -" + distance + " 0\nv -" + distance + " 0.6 0\nf 1 2 3\n");
  }
  std::string solve(const std::string& options) const {
    return "solve " + square() + " --vertices 300 --model model.obj -o w.npy --report report.json" +
           ' ' + options;
  }
};

TEST_F(OutsideCommand, AHairHasOneAnswer) {
  for (const std::string distance : {"0.000000001", "0.000001"}) {
    SCOPED_TRACE(distance);
    const auto of = model(distance);
    EXPECT_NE(run("check " + square() + " --model " + of).output.find("none outside"),
              std::string::npos);
    expect(solve(""), 0, "2 vertices within");
    EXPECT_GE(io::read_weights("w.npy").dense().minCoeff(), 0);
    EXPECT_EQ(json_in("report.json")["outside"]["on_cage"]["count"], 2);
    EXPECT_EQ(json_in("report.json")["outside"]["outside"]["count"], 0);
    expect("check " + square() + " --model " + of + " --weights w.npy");
    expect("sparsify w.npy --cage " + square() + " --points " + of + " -k 3 -q -o few.npy");
    expect("run " + square() + ' ' + of + " --vertices 300 -q -o out");
    EXPECT_EQ(json_in("out/report.json")["solve"]["outside"]["on_cage"]["count"], 2);
  }
  const auto of = model("0.00001");
  EXPECT_NE(run("check " + square() + " --model " + of).output.find("2 of 3 vertices are outside"),
            std::string::npos);
  for (const auto& command :
       {solve(""), "run " + square() + ' ' + of + " --vertices 300 -q -o none"}) {
    const auto refused = expect(command, 2, "2 of 3 vertices are outside the cage");
    EXPECT_NE(refused.errors.find("--outside nearest"), std::string::npos);
  }
}

// Vertices on the cage, slightly outside it, and duplicated, as in real models.
TEST_F(OutsideCommand, EmbeddingTakesModelsAsTheyAre) {
  const auto of = file("model.obj",
                       "v 0.5 0.5 0\nv 0.3 -0.0000001 0\nv 0.5 0.5 0\nv 1 1 0\nv 0.25 0.75 0\n"
                       "v 0 0.4 0\nv 0.25 0.75000000000001 0\nf 1 2 5\nf 3 4 6\n");
  expect(solve("--embed --save-domain domain.obj"), 0, "1 vertices within");
  const auto weights = io::read_weights("w.npy").dense();
  ASSERT_EQ(weights.cols(), 7);
  EXPECT_EQ(weights.col(0), weights.col(2));
  EXPECT_EQ(weights.col(4), weights.col(6));
  EXPECT_NEAR(weights(0, 1), 0.7, 1e-12);
  EXPECT_NEAR(weights(2, 3), 1, 1e-12);
  EXPECT_NEAR(weights(3, 5), 0.4, 1e-12);
  EXPECT_GE(weights.minCoeff(), 0);
  const auto domain = slurp("domain.obj");
  EXPECT_NE(domain.find("v 0.5 0.5"), std::string::npos);
  EXPECT_NE(domain.find("v 0.25 0.75"), std::string::npos);
  model("0.01");
  expect(solve("--embed"), 2, "2 of 3 vertices are outside the cage; the farthest is vertex");
}

TEST_F(OutsideCommand, FartherPointsGoTheWayThatIsAskedFor) {
  const auto of = model("0.25");
  expect(solve("--outside fail"), 2);
  expect(solve("--outside nearest"));
  const auto nearest = io::read_weights("w.npy").dense();
  EXPECT_GE(nearest.minCoeff(), 0);
  EXPECT_NEAR(nearest(0, 1), 0.7, 1e-12);  // (0.3, 0) between control points 0 and 1
  EXPECT_NEAR(nearest(1, 1), 0.3, 1e-12);
  EXPECT_EQ(json_in("report.json")["outside"]["outside"]["count"], 2);
  EXPECT_NEAR(json_in("report.json")["outside"]["outside"]["distance"], 0.25, 1e-12);
  EXPECT_EQ(json_in("report.json")["options"]["outside"], "nearest");
  expect(solve("--outside extend"));
  const auto extended = io::read_weights("w.npy").dense();
  EXPECT_NEAR(extended.col(1).sum(), 1, 1e-12);
  EXPECT_NEAR(extended(1, 1) + extended(2, 1), 0.3, 1e-12);    // x
  EXPECT_NEAR(extended(2, 1) + extended(3, 1), -0.25, 1e-12);  // y
  expect("deform " + of + " --weights w.npy --pose " + square() + " --rest " + square() +
         " -q -o moved.obj");
  expect("run " + square() + ' ' + of + " --outside nearest --vertices 300 -q -o out");
  expect("run " + square() + ' ' + of + " --outside extend --vertices 300 -q -o out", 1);
  expect(solve("--outside nearest --embed"), 1);
  expect(solve("--outside there"), 1);
}

}  // namespace
}  // namespace flbc::testing
