// SPDX-License-Identifier: BSD-3-Clause
// The progress line is for terminals only, and fits one.
#include "support/command_line.h"

namespace flbc::app {
namespace {

using ProgressLine = flbc::testing::CommandLineTest;

TEST_F(ProgressLine, IsForTerminalsOnly) {
  const std::string solve = "solve 3d/limb_cage.obj --method gradient -o w.npy --vertices ";
  flbc::testing::expect_no_piece(expect(solve + "300").errors, "iteration ");
  if (!has_program("script")) GTEST_SKIP() << "no script(1)";
  const auto in_terminal = "script -qec '" + std::string(FLBC_PROGRAM) + " " + solve +
                           "800' log.txt >/dev/null </dev/null";
  ASSERT_EQ(status_of(in_terminal), 0);
  const auto text = flbc::testing::slurp("log.txt");
  const std::string begin = "\rsolving: iteration ";
  int last = 0;
  for (auto at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
    EXPECT_LT(text.find("\033[K", at) - at, 80U);
    const int iteration = std::stoi(text.substr(at + begin.size()));
    EXPECT_GE(iteration, last);
    last = iteration;
  }
  EXPECT_GT(last, 0);
}

}  // namespace
}  // namespace flbc::app
