// SPDX-License-Identifier: BSD-3-Clause
// flbc plot: how solves came nearer to their end, several in one picture.
#include <algorithm>
#include <cmath>
#include <memory>

#include "commands/commands.h"
#include "draw/plot_picture.h"
#include "files/load.h"
#include "flbc/io/files.h"
#include "report/history.h"

namespace flbc::app {
namespace {

struct PlotArguments {
  std::vector<std::string> reports;
  std::vector<std::string> names;
  std::string output;
  draw::WeightPictureOptions options;
};

double largest_residual(const RunHistory&, const HistoryEntry& entry) {
  return std::max(entry.relative_primal_residual, entry.relative_dual_residual);
}

double estimated_error(const RunHistory&, const HistoryEntry& entry) {
  return entry.estimated_error;
}

double objective_of(const RunHistory&, const HistoryEntry& entry) {
  return entry.objective;
}

double gap_of(const RunHistory& run, const HistoryEntry& entry) {
  return (entry.objective - run.lower_bound) / entry.objective;
}

struct Row {
  const char* label;
  bool logarithmic;
  double (*value)(const RunHistory&, const HistoryEntry&);
};

constexpr Row kRows[] = {{"estimated error (mean squared)", true, estimated_error},
                         {"residual / threshold", true, largest_residual},
                         {"objective", false, objective_of},
                         {"gap to the certified bound", true, gap_of}};

draw::PlotPanel make_panel(const std::vector<RunHistory>& runs, const Row& row, bool in_seconds) {
  draw::PlotPanel panel;
  panel.x_label = in_seconds ? "seconds" : "iterations";
  panel.y_label = row.label;
  panel.logarithmic = row.logarithmic;
  for (const auto& run : runs) {
    auto& curve = panel.curves.emplace_back();
    for (const auto& entry : run.entries) {
      curve.emplace_back(in_seconds ? entry.seconds : entry.iteration, row.value(run, entry));
    }
  }
  return panel;
}

bool has_points(const draw::PlotPanel& panel) {
  for (const auto& curve : panel.curves) {
    for (const auto& p : curve) {
      if (p.allFinite() && (!panel.logarithmic || p.y() > 0)) return true;
    }
  }
  return false;
}

std::vector<std::string> names_of_runs(const PlotArguments& arguments) {
  return arguments.names.empty() ? arguments.reports : arguments.names;
}

void plot(PlotArguments& arguments) {
  arguments.options.format = draw::picture_format(arguments.output);
  require_writable(arguments.output, io::extension_of(arguments.output).c_str());
  require_distinct(arguments.reports, {arguments.output});
  if (!arguments.names.empty() && arguments.names.size() != arguments.reports.size()) {
    throw OptionError("--names: " + std::to_string(arguments.names.size()) + " names for " +
                      std::to_string(arguments.reports.size()) + " reports; give one for each");
  }
  std::vector<RunHistory> runs;
  for (const auto& file : arguments.reports) runs.push_back(read_history(file));
  std::vector<draw::PlotPanel> panels;
  for (const auto& row : kRows) {
    for (const bool in_seconds : {false, true}) {
      auto panel = make_panel(runs, row, in_seconds);
      if (has_points(panel)) panels.push_back(std::move(panel));
    }
  }
  write_text(arguments.output,
             draw::draw_plot(names_of_runs(arguments), panels, 2, arguments.options));
}

}  // namespace

void add_plot_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<PlotArguments>();
  auto& a = *arguments;
  auto* command =
      app.add_subcommand("plot", "plot error, residual, objective, and gap of one or more solves");
  command->add_option("REPORTS", a.reports, "reports of flbc solve or flbc run with --history")
      ->required();
  command->add_option("-o,--output", a.output, std::string("picture: ") + draw::kPictureExtensions)
      ->required();
  command->add_option("--names", a.names, "legend labels (default: the file names)");
  command->add_option("--width", a.options.width, "width in pixels (default: 1200)");
  command->callback([arguments] { plot(*arguments); });
}

}  // namespace flbc::app
