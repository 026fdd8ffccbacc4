// SPDX-License-Identifier: BSD-3-Clause
// Regenerates the numbers of the paper's tables and figures; see README.md in this folder.
#include <cstdio>
#include <exception>
#include <filesystem>

#include <CLI/CLI.hpp>

#include "experiments.h"
#include "problems.h"

namespace flbc::bench {
namespace {

// In the order in which to run them.
constexpr struct {
  const char* name;
  bool (*run)(const Context&);
} kExperiments[] = {{"table1", run_table1}, {"table2", run_table2}, {"models", run_models},
                    {"race", run_race},     {"speed", run_speed},   {"samples", run_samples}};

bool run_all(const Context& context, const std::vector<std::string>& only) {
  std::filesystem::create_directories(context.out);
  bool complete = true;
  for (const auto& [name, run] : kExperiments) {
    if (!only.empty() && std::find(only.begin(), only.end(), name) == only.end()) continue;
    const Stopwatch watch;
    complete = run(context) && complete;
    std::printf("%s: %.1f s\n\n", name, watch.seconds());
    std::fflush(stdout);
  }
  return complete;
}

int run(int argc, char** argv) {
  Context context;
  context.threads = available_cores();
  std::vector<std::string> only;
  std::vector<std::string> names;
  for (const auto& experiment : kExperiments) names.emplace_back(experiment.name);
  std::vector<std::string> model_names;
  for (const auto& model : models()) model_names.push_back(model.name);
  CLI::App app("Regenerates the numbers of the paper's tables and figures");
  app.add_option("MODELS", context.models, "folder of the cages, with 2d/ and 3d/")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_option("OUT", context.out, "folder for the results")->required();
  app.add_flag("--quick", context.quick, "small meshes and few iterations");
  app.add_option("--only", only, "names of tables and figures, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
  app.add_option("--models", context.only_models, "names of models, separated by commas (all)")
      ->delimiter(',')
      ->check(CLI::IsMember(model_names));
  app.add_option("--threads", context.threads, "number of threads (all cores)")
      ->check(CLI::Range(1, 1024));
  app.add_flag("--busy", context.busy, "say in the results that other programs ran as well");
  app.add_option("--origin", context.origin, "commit and behavior, for the results");
  CLI11_PARSE(app, argc, argv);
  return run_all(context, only) ? 0 : 1;
}

}  // namespace
}  // namespace flbc::bench

int main(int argc, char** argv) {
  try {
    if (argc == 2 && argv[1] == std::string("--behavior")) {
      std::puts(flbc::bench::behavior().c_str());
      return 0;
    }
    return flbc::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "flbc_bench_paper: %s\n", error.what());
    return 1;
  }
}
