// SPDX-License-Identifier: BSD-3-Clause
#include "report/history.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

namespace flbc::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Names in the report, and what they stand for.
struct Quantity {
  const char* name;
  double HistoryEntry::*value;
};

constexpr Quantity kQuantities[] = {
    {"seconds", &HistoryEntry::seconds},
    {"estimated_error", &HistoryEntry::estimated_error},
    {"relative_primal_residual", &HistoryEntry::relative_primal_residual},
    {"relative_dual_residual", &HistoryEntry::relative_dual_residual},
    {"objective", &HistoryEntry::objective}};

}  // namespace

HistoryRecorder::HistoryRecorder(const SolverOptions& options)
    : start_(std::chrono::steady_clock::now()) {
  const auto resolved = resolve(options);
  const bool estimates =
      resolved.method == Method::kWeights || resolved.method == Method::kGradient;
  if (estimates) tolerance_ = *resolved.tolerance;
}

void HistoryRecorder::note(const Progress& progress) {
  const auto now = std::chrono::steady_clock::now();
  const bool has_objective = progress.objective && progress.finer_levels == 0;
  entries_.push_back({progress.iteration, progress.finer_levels, seconds_until(now),
                      tolerance_ > 0 ? progress.relative_primal_residual * tolerance_ : kNone,
                      progress.relative_primal_residual, progress.relative_dual_residual,
                      has_objective ? progress.objective() : kNone});
  start_ += std::chrono::steady_clock::now() - now;
}

double HistoryRecorder::seconds_until(std::chrono::steady_clock::time_point now) const {
  return std::chrono::duration<double>(now - start_).count();
}

std::vector<HistoryEntry> HistoryRecorder::finished(const SolveReport& report) {
  if (report.iterations == 0) return {};
  // Recovery and certificate come after the iteration.
  const double seconds = seconds_until(std::chrono::steady_clock::now()) - report.seconds.recover -
                         report.seconds.certify;
  entries_.push_back({report.iterations, 0, seconds,
                      tolerance_ > 0 ? report.relative_primal_residual * tolerance_ : kNone,
                      report.relative_primal_residual, report.relative_dual_residual,
                      report.objective});
  int coarse = 0;
  for (const auto& level : report.coarse_levels) coarse += level.iterations;
  for (auto& entry : entries_) entry.iteration += entry.finer_levels == 0 ? coarse : 0;
  return std::move(entries_);
}

Json history_json(const std::vector<HistoryEntry>& history) {
  Json json;
  for (const auto& entry : history) {
    json["iterations"].push_back(entry.iteration);
    json["finer_levels"].push_back(entry.finer_levels);
    for (const auto& [name, value] : kQuantities) {
      const double number = entry.*value;
      json[name].push_back(std::isfinite(number) ? Json(number) : Json());
    }
  }
  return json;
}

}  // namespace flbc::app
