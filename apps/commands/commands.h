// SPDX-License-Identifier: BSD-3-Clause
// The subcommands.
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <string>

#include "flbc/types.h"
#include "help/options.h"

namespace flbc::app {

//! Exit status of the program: stable, scripts depend on it.
enum ExitStatus : int {
  kDone = 0,
  kWrongUsage = 1,    //!< unknown or impossible options
  kBadInput = 2,      //!< a defect in a file's content
  kNotConverged = 3,  //!< results are written nevertheless, the report says so
  kIoFailure = 4,     //!< a file cannot be opened, read or written
  kOutOfMemory = 5
};

//! Adds a subcommand to the command line. Its callback changes the exit status unless it is kDone.
using AddCommand = void(CLI::App& app, int& exit_status);
AddCommand add_adjoint_command, add_cage_command, add_check_command, add_compare_command,
    add_compose_command, add_convert_command, add_deform_command, add_draw_command,
    add_export_command, add_fit_command, add_info_command, add_mesh_command, add_run_command,
    add_solve_command, add_sparsify_command, add_transfer_command, add_view_command;

//! Complaint about a number of vertices, for CLI::Option::check(); empty if it is fine.
inline std::string refuse_vertex_count(const std::string& text) {
  Index count = 0;
  const auto* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, count);
  if (parsed.ec == std::errc() && parsed.ptr == end && count > 0) return {};
  return "must be a positive whole number such as 20000, not '" + text + "'";
}

}  // namespace flbc::app
