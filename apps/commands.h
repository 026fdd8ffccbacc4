// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The subcommands. Each adds itself to the command line and leaves its action as callback, which
//! stores the exit status.
#pragma once

#include <CLI/CLI.hpp>

namespace flbc::app {

void add_mesh_command(CLI::App& app, int& exit_status);
void add_solve_command(CLI::App& app, int& exit_status);
void add_draw_command(CLI::App& app, int& exit_status);
void add_info_command(CLI::App& app, int& exit_status);

}  // namespace flbc::app
