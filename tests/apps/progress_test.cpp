// SPDX-License-Identifier: BSD-3-Clause
// The progress line: within 80 columns, never going back, with the time that is left.
#include "solve/progress_estimate.h"
#include "support/command_line.h"

namespace flbc::app {
namespace {

TEST(ProgressEstimate, NeverGoesBackAndFitsALine) {
  for (const Method method : {Method::kWeights, Method::kGradient}) {
    SolverOptions options{method};
    ProgressEstimate estimate(options);
    EXPECT_EQ(estimate.line("meshing the cage", 2.5), "meshing the cage, 3 s");
    double done = 0, seconds = 0;
    for (int level = 2; level >= 0; --level) {
      // Falls, with jumps back as real residuals have.
      for (int k = 1; k <= 50; ++k) {
        const double residual = std::pow(10.0, 5 - k / 10.0) * (k % 7 == 0 ? 40 : 1);
        estimate.update({10 * k, residual, 0, level, {}}, seconds += 30);
        EXPECT_GE(estimate.done(), done);
        EXPECT_LE(estimate.done(), 1);
        done = estimate.done();
        const auto line = estimate.line("", seconds);
        EXPECT_LE(line.size(), 79U) << line;
        if (done > 0.1) {
          flbc::testing::expect_piece(line, " left");
        }
      }
      EXPECT_GT(done, level == 0 ? 0.99 : 0.02);
    }
    flbc::testing::expect_piece(estimate.line("", seconds), "100%");
    // No progress is reported after the iteration.
    EXPECT_EQ(estimate.line("", seconds + 1000).substr(0, 9), "finishing");
  }
}

TEST(ProgressEstimate, StagesTellTheTimeThatIsLeft) {
  ProgressEstimate estimate(SolverOptions{});
  estimate.update_stage("measuring distances", 0, 10);
  estimate.update_stage("measuring distances", 0.25, 13);
  EXPECT_EQ(estimate.line("setting up", 13),
            "measuring distances [#####...............] 25%, 9 s left");
  estimate.update_stage("measuring distances", 0.2, 14);  // nothing is taken back
  flbc::testing::expect_piece(estimate.line("setting up", 14), "25%");
  estimate.update({1, 100, 0, 0, {}}, 20);
  EXPECT_EQ(estimate.line("", 20).substr(0, 7), "solving");
  estimate.update_stage("proving the gap", 0.5, 30);
  EXPECT_EQ(estimate.line("", 32), "proving the gap [##########..........] 50%, 2 s left");
}

TEST(ProgressEstimate, TheTimeLeftIsRightForASteadyFall) {
  ProgressEstimate estimate(SolverOptions{});
  for (int k = 0; k <= 50; ++k) {
    estimate.update({10 * k + 1, std::pow(10.0, 10 - k / 10.0), 0, 0, {}}, 5.0 + k);
  }
  // Half of the way of the logarithm took 50 s.
  flbc::testing::expect_piece(estimate.line("", 55), "50%, 50 s left");
}

using ProgressLine = flbc::testing::CommandLineTest;

TEST_F(ProgressLine, IsForTerminalsOnly) {
  const std::string solve = "solve 3d/limb_cage.obj --method gradient -o w.npy --vertices ";
  flbc::testing::expect_no_piece(expect(solve + "300").errors, "solving [");
  if (!has_program("script")) GTEST_SKIP() << "no script(1)";
  const auto in_terminal = "script -qec '" + std::string(FLBC_PROGRAM) + " " + solve +
                           "2500' log.txt >/dev/null </dev/null";
  ASSERT_EQ(status_of(in_terminal), 0);
  const auto text = flbc::testing::slurp("log.txt");
  int last = 0;
  std::size_t lines = 0;
  for (auto at = text.find("\rsolving ["); at != std::string::npos;
       at = text.find("\rsolving [", at + 1)) {
    const auto line = text.substr(at + 1, text.find("\033[K", at) - at - 1);
    EXPECT_LT(line.size(), 80U) << line;
    const int percent = std::stoi(line.substr(line.find(']') + 1));
    EXPECT_GE(percent, last);
    last = percent;
    ++lines;
  }
  EXPECT_GT(lines, 0U);
}

}  // namespace
}  // namespace flbc::app
