// SPDX-License-Identifier: BSD-3-Clause
// flbc solve --checkpoint: killed at any moment, the same command ends with the same files.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <random>
#include <sstream>

#include <nlohmann/json.hpp>

#include "support/command_line.h"

namespace flbc::testing {
namespace {

namespace fs = std::filesystem;

class CheckpointCommand : public CommandLineTest {
 protected:
  std::string solve(const std::string& cage, const std::string& name,
                    const std::string& more) const {
    return "solve " + sample(cage) + " -o " + path(name + ".npy") + " --report " +
           path(name + ".json") + " " + more;
  }
  std::string keeping() const {
    return " --checkpoint " + path("state") + " --checkpoint-every 0 ";
  }

  // The exit status, as a shell gives it, of a run that a signal may end.
  int run_until(double seconds, int signal, const std::string& arguments) const {
    std::ostringstream command;
    command << "timeout --preserve-status -s " << signal << " " << seconds << " " << FLBC_PROGRAM
            << " " << arguments << " >/dev/null 2>" << path("errors") << " </dev/null";
    const int status = std::system(command.str().c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  nlohmann::json report(const std::string& name) const {
    auto json = nlohmann::json::parse(slurp(path(name + ".json")));
    json.erase("seconds");
    for (auto& level : json["coarse_levels"]) level.erase("seconds");
    if (json.contains("history")) json["history"].erase("seconds");
    return json;
  }

  bool left_temporary_file() const {
    for (const auto& entry : fs::directory_iterator(path("."))) {
      if (entry.path().extension() == ".tmp") return true;
    }
    return false;
  }

  void expect_same_results() const {
    EXPECT_TRUE(slurp(path("killed.npy")) == slurp(path("whole.npy")));
    EXPECT_EQ(report("killed"), report("whole"));
    EXPECT_FALSE(fs::exists(path("state")));
  }

  static double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  // Files that nobody wants any more, as only SIGKILL leaves them; weights are whole if there.
  void expect_nothing_half_written(int signal) {
    if (signal != SIGKILL) {
      EXPECT_FALSE(left_temporary_file());
    }
    for (const auto& entry : fs::directory_iterator(path("."))) {
      if (entry.path().extension() == ".tmp") fs::remove(entry.path());
    }
    if (!fs::exists(path("killed.npy"))) return;
    EXPECT_TRUE(slurp(path("killed.npy")) == slurp(path("whole.npy")));
    fs::remove(path("killed.npy"));
  }

  // Kills runs at random moments, each of which goes on from where the one before was.
  void kill_at_random(int kills, const std::string& cage, const std::string& options,
                      unsigned seed) {
    auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(run(solve(cage, "whole", options)).status, 0);
    double whole = seconds_since(start);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> part(0, 1);
    const int signals[] = {SIGINT, SIGTERM, SIGKILL};
    const auto command = solve(cage, "killed", options + keeping());
    int went_on = 0;
    for (int kill = 0; kill < kills || (went_on == 0 && kill < 10 * kills); ++kill) {
      const int signal = signals[kill % 3];
      went_on += fs::exists(path("state"));
      start = std::chrono::steady_clock::now();
      const int status = run_until(part(random) * whole, signal, command);
      if (status == 0) {
        expect_same_results();
        whole = std::min(whole, seconds_since(start));  // the machine was busy before
        fs::remove(path("killed.npy"));
        continue;
      }
      EXPECT_EQ(status, 128 + signal) << slurp(path("errors"));
      expect_nothing_half_written(signal);
    }
    EXPECT_GT(went_on, 0);
    ASSERT_EQ(run(command).status, 0);
    expect_same_results();
  }
};

TEST_F(CheckpointCommand, ManyKillsInThePlane) {
  kill_at_random(10, "2d/figure_cage.obj", "--vertices 1500 --history", 1);
}

TEST_F(CheckpointCommand, ManyKillsInSpaceFromCoarserMeshes) {
  kill_at_random(10, "3d/limb_cage.obj", "--vertices 1500 --tolerance 1e-10 --coarse-to-fine on",
                 2);
}

TEST_F(CheckpointCommand, InterruptedRunSaysHowToGoOn) {
  const auto command = solve("3d/limb_cage.obj", "killed",
                             "--vertices 1500 --tolerance 1e-14 "
                             "--checkpoint " +
                                 path("state"));
  int status = 0;
  for (double seconds = 2; seconds < 60 && !fs::exists(path("state")); seconds *= 2) {
    status = run_until(seconds, SIGINT, command);
  }
  EXPECT_EQ(status, 130);
  const auto errors = slurp(path("errors"));
  EXPECT_NE(errors.find("the same command goes on from " + path("state") + ", at iteration "),
            std::string::npos)
      << errors;
}

TEST_F(CheckpointCommand, LimitOfIterationsKeepsTheState) {
  const std::string cage = "3d/star_cage.obj";
  const std::string options = "--vertices 600 --tolerance 1e-9 ";
  ASSERT_EQ(run(solve(cage, "whole", options)).status, 0);
  const auto stopped = run(solve(cage, "killed", options + keeping() + "--max-iterations 60"));
  EXPECT_EQ(stopped.status, 3);
  EXPECT_NE(stopped.errors.find("goes on from " + path("state")), std::string::npos)
      << stopped.errors;
  const auto on = run(solve(cage, "killed", options + keeping()));
  EXPECT_EQ(on.status, 0);
  EXPECT_NE(on.errors.find("going on from " + path("state") + ", at iteration "), std::string::npos)
      << on.errors;
  auto whole = report("whole"), killed = report("killed");
  EXPECT_EQ(killed, whole);
  EXPECT_TRUE(slurp(path("killed.npy")) == slurp(path("whole.npy")));
}

TEST_F(CheckpointCommand, FileOfAnotherRunIsRefused) {
  const std::string options = "--vertices 600 --max-iterations 60 --tolerance 1e-9" + keeping();
  const auto first = solve("3d/star_cage.obj", "a", options);
  ASSERT_EQ(run(first).status, 3);
  const auto state = slurp(path("state"));
  const auto expect_refused = [&](const std::string& command, const std::string& name) {
    const auto refused = run(command);
    EXPECT_EQ(refused.status, 2) << command;
    EXPECT_NE(refused.errors.find("--checkpoint " + path("state") +
                                  ": it was left by another "
                                  "command: '" +
                                  name + "' differs"),
              std::string::npos)
        << refused.errors;
    EXPECT_TRUE(slurp(path("state")) == state);
  };
  expect_refused(solve("3d/torus_cage.obj", "a", options), "control_points");
  expect_refused(first + " --phi linear", "phi");
  expect_refused(first + " --penalty 10", "published_penalty");
  expect_refused(first + " --history", "history");
  expect_refused(solve("3d/star_cage.obj", "a",
                       "--vertices 700 --max-iterations 60 --tolerance 1e-9" + keeping()),
                 "vertices");
  expect_refused(solve("3d/star_cage.obj", "a",
                       "--vertices 600 --max-iterations 60 --tolerance 1e-8" + keeping()),
                 "tolerance");
  expect_refused(solve("2d/figure_cage.obj", "a", options), "dim");
}

TEST_F(CheckpointCommand, DamagedFileIsRefused) {
  const auto command = solve("3d/star_cage.obj", "a",
                             "--vertices 600 --max-iterations 60 --tolerance 1e-9" + keeping());
  ASSERT_EQ(run(command).status, 3);
  const auto state = slurp(path("state"));
  auto flipped = state;
  flipped[flipped.size() / 2] ^= 1;
  for (const auto& content :
       {std::string(), std::string("v 0 0 0\n"), state.substr(0, state.size() / 2), flipped}) {
    file("state", content);
    const auto refused = run(command);
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.errors.find("--checkpoint " + path("state") + ": it is "), std::string::npos)
        << refused.errors;
  }
}

TEST_F(CheckpointCommand, OptionsThatCannotBeFollowedAreRefused) {
  EXPECT_EQ(run(solve("3d/star_cage.obj", "a", "--method harmonic" + keeping())).status, 1);
  EXPECT_EQ(run(solve("3d/star_cage.obj", "a", "--checkpoint-every 5")).status, 1);
  EXPECT_EQ(run(solve("3d/star_cage.obj", "a", "--checkpoint " + path("none/state"))).status, 4);
  EXPECT_EQ(
      run(solve("3d/star_cage.obj", "a", "--checkpoint " + sample("3d/star_cage.obj"))).status, 1);
}

TEST_F(CheckpointCommand, RunGoesOnAsWell) {
  const auto command =
      "run " + sample("2d/figure_cage.obj") + " --vertices 1500 --tolerance 1e-10 -o ";
  const auto stopped = run(command + path("out") + keeping() + "--max-iterations 200");
  ASSERT_EQ(stopped.status, 3) << stopped.errors;
  ASSERT_TRUE(fs::exists(path("state")));
  ASSERT_EQ(run(command + path("out") + keeping()).status, 0);
  EXPECT_FALSE(fs::exists(path("state")));
  ASSERT_EQ(run(command + path("whole")).status, 0);
  EXPECT_TRUE(slurp(path("out/weights.npy")) == slurp(path("whole/weights.npy")));
}

}  // namespace
}  // namespace flbc::testing
