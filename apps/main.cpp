// SPDX-License-Identifier: BSD-3-Clause
// flbc: local barycentric coordinates from the command line. A file per subcommand.
#include <omp.h>

#include <algorithm>
#include <iostream>
#include <new>
#include <string>
#include <utility>

#include "commands/commands.h"
#include "flbc/errors.h"
#include "flbc/version.h"
#include "front/system/system.h"
#include "front/wording.h"

namespace {

int fail(int exit_status, const char* what) {
  std::cerr << "flbc: " << flbc::app::in_words_of_program(what) << '\n';
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

std::string version() {
  const std::string without = FLBC_WITHOUT;
  return "flbc " FLBC_VERSION FLBC_COMMIT "\nwith " FLBC_WITH +
         (without.empty() ? "" : "\nwithout " + without) +
         "\nlicense of this program: " FLBC_LICENSE;
}

// Where CLI11 is brief or unclear.
std::string in_our_words(std::string message) {
  constexpr std::pair<const char*, const char*> kPhrases[] = {
      {" excludes ", " cannot be combined with "},
      {"The following argument was not expected: ", "unexpected argument: "},
      {"The following arguments were not expected: ", "unexpected arguments: "}};
  for (const auto& [theirs, ours] : kPhrases) {
    const auto at = message.find(theirs);
    if (at != std::string::npos) message.replace(at, std::string(theirs).size(), ours);
  }
  return message;
}

std::string describe_usage_error(const CLI::App* app, const CLI::Error& error) {
  std::string command = "flbc";
  for (const auto* chosen : app->get_subcommands()) command += " " + chosen->get_name();
  return command + ": " + in_our_words(error.what()) + "; see " + command + " --help\n";
}

// Results that were meant for standard output and are lost must not pass for done.
void require_output() {
  if (!std::cout.flush()) throw flbc::IoError("standard output: cannot write");
}

int run(int argc, char** argv) {
  using namespace flbc::app;
  CLI::App app{
      "Local barycentric coordinates of cages in 2D and 3D.\n"
      "Exit status: 0 done, 1 wrong usage, 2 bad input, 3 not converged, 4 I/O failure, "
      "5 out of memory.",
      "flbc"};
  app.formatter(help_formatter());
  app.allow_windows_style_options(false);  // a path may begin with a slash
  app.set_help_flag("-h,--help", "print this help and exit");
  app.set_version_flag("--version", version(), "print version, components, and license, and exit");
  app.require_subcommand(1);
  app.failure_message(describe_usage_error);
  int exit_status = kDone;
  for (auto* add :
       {add_run_command, add_cage_command, add_mesh_command, add_solve_command, add_check_command,
        add_compare_command, add_compose_command, add_convert_command, add_deform_command,
        add_fit_command, add_adjoint_command, add_sparsify_command, add_transfer_command,
        add_export_command, add_draw_command, add_view_command, add_info_command}) {
    add(app, exit_status);
  }
  for (auto* command : app.get_subcommands([](CLI::App*) { return true; })) {
    command->group("Commands");
    add_help_all(*command);
  }
  refuse_empty_values(app);
  if (argc > 1 && argv[1][0] != '-' && !has_command(app, argv[1])) {
    throw flbc::OptionError("unknown command '" + std::string(argv[1]) + "'; see flbc --help");
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help and --version
    const int status = app.exit(request);
    require_output();
    return status;
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    return kWrongUsage;
  }
  require_output();
  return exit_status;
}

// A system that limits threads must not end the program.
void limit_threads() {
  constexpr int kMostThreads = 64;
  const int most = std::max(kMostThreads, omp_get_num_procs());
  if (omp_get_max_threads() > most) omp_set_num_threads(most);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace flbc::app;
  adapt_to_system();
  limit_threads();
  try {
    return run(argc, argv);
  } catch (const flbc::OptionError& error) {
    return fail(kWrongUsage, error.what());
  } catch (const flbc::IoError& error) {
    return fail(kIoFailure, error.what());
  } catch (const flbc::Error& error) {
    return fail(kBadInput, error.what());
  } catch (const std::bad_alloc&) {
    return fail(kOutOfMemory, "out of memory; try fewer --vertices");
  } catch (const std::exception& error) {
    return fail(kBadInput, error.what());
  }
}
