// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The subcommands. Each adds itself to the command line and leaves its action as callback, which
//! stores the exit status.
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <string>

#include "flbc/types.h"

namespace flbc::app {

void add_cage_command(CLI::App& app, int& exit_status);
void add_man_command(CLI::App& app, int& exit_status);
void add_mesh_command(CLI::App& app, int& exit_status);
void add_solve_command(CLI::App& app, int& exit_status);
void add_check_command(CLI::App& app, int& exit_status);
void add_completion_command(CLI::App& app, int& exit_status);
void add_convert_command(CLI::App& app, int& exit_status);
void add_deform_command(CLI::App& app, int& exit_status);
void add_draw_command(CLI::App& app, int& exit_status);
void add_export_command(CLI::App& app, int& exit_status);
void add_info_command(CLI::App& app, int& exit_status);
void add_plot_command(CLI::App& app, int& exit_status);
void add_run_command(CLI::App& app, int& exit_status);
void add_sparsify_command(CLI::App& app, int& exit_status);
void add_transfer_command(CLI::App& app, int& exit_status);
void add_view_command(CLI::App& app, int& exit_status);

//! Complaint about a number of vertices, for CLI::Option::check(); empty if it is fine.
inline std::string refuse_vertex_count(const std::string& text) {
  Index count = 0;
  const auto* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, count);
  if (parsed.ec == std::errc() && parsed.ptr == end && count > 0) return {};
  return "must be a positive whole number as 20000, not '" + text + "'";
}

}  // namespace flbc::app
