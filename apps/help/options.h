// SPDX-License-Identifier: BSD-3-Clause
// Options of commands, and how --help shows them.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "flbc/report.h"
#include "front/poses.h"
#include "front/up_axis.h"

namespace flbc::app {

//! The group of options that --help leaves out and --help-all shows.
constexpr const char* kMore = "More options";

//! Formats --help: few options, in groups, with lines that fit a terminal.
std::shared_ptr<CLI::Formatter> help_formatter();

//! Adds --help-all to a command that has all its options. Only where some are in the group kMore
//! does --help show it.
void add_help_all(CLI::App& command);

//! Adds an option whose value is one of a few words. \param take  stores the word
CLI::Option* add_choice(CLI::App& command, const std::string& name,
                        const std::vector<std::string>& words,
                        const std::function<void(const std::string&)>& take,
                        const std::string& help);

//! The same for words as they are.
inline CLI::Option* add_choice(CLI::App& command, const std::string& name,
                               const std::vector<std::string>& words, std::string& value,
                               const std::string& help) {
  return add_choice(
      command, name, words, [&value](const auto& word) { value = word; }, help);
}

//! The same for the names of an enumeration. \param words  some of names_of<Enum>()
template <class Enum>
CLI::Option* add_choice(CLI::App& command, const std::string& name, Enum& value,
                        const std::string& help,
                        const std::vector<std::string>& words = names_of<Enum>()) {
  const auto take = [&value](const std::string& word) { value = *value_named<Enum>(word); };
  return add_choice(command, name, words, take, help);
}

//! Complaint about text that is no number from low to high, for CLI::Option::check().
std::function<std::string(const std::string&)> in_range(double low, double high);

//! The text with line breaks between words. \param width  maximum number of letters in a line
//! \param line_break  "\n", and what indents the next line
std::string wrapped(const std::string& text, std::size_t width, const std::string& line_break);

//! Adds --cage, the rest cage of weights that have none.
inline CLI::Option* add_cage_option(CLI::App& command, std::string& cage) {
  return command.add_option("--cage", cage, "rest cage of the weights; a .npz file has it");
}

//! Adds --joint.
inline CLI::Option* add_joint_option(CLI::App& command, std::string& joint) {
  return command
      .add_option("--joint", joint,
                  "how the deformation ends where the mesh passes through the cage: smooth, "
                  "curvature, or one with the mass from which on nothing changes, as in smooth:0.3")
      ->type_name("JOINT");
}

//! Adds --up of the commands that show or export models, with the default kAuto.
inline CLI::Option* add_up_option(CLI::App& command, UpAxis& up) {
  return add_choice(
      command, "--up", {"x", "y", "z", "auto"},
      [&up](const std::string& axis) {
        up = axis == "auto" ? UpAxis::kAuto : static_cast<UpAxis>(axis[0] - 'x');
      },
      "axis of a 3D model that points up (default: auto: y for glTF, otherwise by its lowest "
      "vertices)");
}

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
