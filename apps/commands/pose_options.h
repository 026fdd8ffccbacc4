// SPDX-License-Identifier: BSD-3-Clause
// The options of commands for poses of the cage.
#pragma once

#include <CLI/CLI.hpp>

#include "front/poses.h"
#include "help/options.h"

namespace flbc::app {

//! Adds --pose.
inline CLI::Option* add_pose_option(CLI::App& command, PoseArguments& poses) {
  return command.add_option("--pose", poses.cages,
                            "deformed cage: one or more files, or a pattern such as pose_%d.obj");
}

//! Adds --fps. \param cages  --pose
inline CLI::Option* add_rate_option(CLI::App& command, PoseArguments& poses, CLI::Option* cages) {
  return command
      .add_option("--fps", poses.frames_per_second,
                  "poses of --pose per second (default: 24, or 1 for one pose, from rest)")
      ->check(in_range(1e-3, 1e6))
      ->needs(cages);
}

}  // namespace flbc::app
