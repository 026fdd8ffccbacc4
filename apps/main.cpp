// SPDX-License-Identifier: BSD-3-Clause
// flbc: local barycentric coordinates from the command line. A file per subcommand.
#include <iostream>
#include <new>
#include <string>

#include "commands/commands.h"
#include "commands/exit_status.h"
#include "flbc/errors.h"
#include "flbc/version.h"

namespace {

int fail(int exit_status, const char* what) {
  std::cerr << "flbc: " << what << '\n';
  return exit_status;
}

// CLI11 would only say that a command is required.
bool has_command(const CLI::App& app, const std::string& name) {
  return !app.get_subcommands([&](const CLI::App* command) { return command->get_name() == name; })
              .empty();
}

// An empty name, as of an unset variable in a script, must not pass for an option left out.
void refuse_empty_values(CLI::App& app) {
  for (auto* command : app.get_subcommands([](CLI::App*) { return true; })) {
    for (auto* option : command->get_options()) {
      if (option->get_expected_min() == 0) continue;
      option->check([](const std::string& text) {
        return text.empty() ? std::string("the value is empty") : std::string();
      });
    }
  }
}

int run(int argc, char** argv) {
  using namespace flbc::app;
  CLI::App app{
      "Local barycentric coordinates of cages in 2D and 3D.\n"
      "Exit status: 0 done, 1 wrong usage, 2 bad input, 3 not converged, 4 I/O failure."};
  app.set_version_flag("--version", "flbc " FLBC_VERSION);
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);
  int exit_status = kDone;
  add_run_command(app, exit_status);
  add_cage_command(app, exit_status);
  add_mesh_command(app, exit_status);
  add_solve_command(app, exit_status);
  add_check_command(app, exit_status);
  add_convert_command(app, exit_status);
  add_deform_command(app, exit_status);
  add_sparsify_command(app, exit_status);
  add_transfer_command(app, exit_status);
  add_export_command(app, exit_status);
  add_draw_command(app, exit_status);
  add_plot_command(app, exit_status);
  add_view_command(app, exit_status);
  add_info_command(app, exit_status);
  refuse_empty_values(app);
  if (argc > 1 && argv[1][0] != '-' && !has_command(app, argv[1])) {
    throw flbc::OptionError("there is no command '" + std::string(argv[1]) + "'; see flbc --help");
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help and --version
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    return kWrongUsage;
  }
  return exit_status;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace flbc::app;
  try {
    return run(argc, argv);
  } catch (const flbc::OptionError& error) {
    return fail(kWrongUsage, error.what());
  } catch (const flbc::IoError& error) {
    return fail(kIoFailure, error.what());
  } catch (const flbc::Error& error) {
    return fail(kBadInput, error.what());
  } catch (const std::bad_alloc&) {
    return fail(kBadInput, "out of memory; try fewer --vertices");
  } catch (const std::exception& error) {
    return fail(kBadInput, error.what());
  }
}
