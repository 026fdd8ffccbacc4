// SPDX-License-Identifier: BSD-3-Clause
#include "report/history.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "flbc/errors.h"
#include "flbc/io/files.h"

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

double number_or_none(const Json& value) {
  return value.is_null() ? kNone : value.get<double>();
}

// Beyond an int, the conversion from JSON would give any number.
int small_integer(const Json& value) {
  constexpr std::int64_t kLargest = std::numeric_limits<int>::max();
  const auto number = value.is_number_integer() ? value.get<std::int64_t>() : -1;
  if (number < 0 || number > kLargest)
    throw InputError(value.dump() + " is not a number of iterations");
  return static_cast<int>(number);
}

RunHistory parse(const Json& solve) {
  const auto& history = solve.at("history");
  RunHistory run;
  run.lower_bound = solve.contains("lower_bound") ? number_or_none(solve["lower_bound"]) : kNone;
  const auto count = history.at("iterations").size();
  run.entries.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    auto& entry = run.entries[k];
    entry.iteration = small_integer(history["iterations"].at(k));
    entry.finer_levels = small_integer(history.at("finer_levels").at(k));
    for (const auto& [name, value] : kQuantities) {
      entry.*value = number_or_none(history.at(name).at(k));
    }
  }
  return run;
}

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
  if (!entries_.empty() && entries_.back().finer_levels != progress.finer_levels) {
    earlier_ = entries_.back().iteration;
  }
  const bool has_objective = progress.objective && progress.finer_levels == 0;
  entries_.push_back({earlier_ + progress.iteration, progress.finer_levels, seconds_until(now),
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
  if (!entries_.empty() && entries_.back().finer_levels > 0) earlier_ = entries_.back().iteration;
  // Recovery and certificate come after the iteration.
  const double seconds = seconds_until(std::chrono::steady_clock::now()) - report.seconds.recover -
                         report.seconds.certify;
  entries_.push_back({earlier_ + report.iterations, 0, seconds,
                      tolerance_ > 0 ? report.relative_primal_residual * tolerance_ : kNone,
                      report.relative_primal_residual, report.relative_dual_residual,
                      report.objective});
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

RunHistory read_history(const std::string& file) {
  Json report;
  try {
    report = Json::parse(io::read_file(file));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(file + ": not a report: " + error.what());
  }
  const auto& solve = report.contains("solve") ? report["solve"] : report;
  if (!solve.is_object() || !solve.contains("history")) {
    throw InputError(
        file +
        ": has no history; write the report with flbc solve --history or flbc run --history");
  }
  try {
    return parse(solve);
  } catch (const InputError& error) {
    throw InputError(file + ": the history is damaged: " + error.what());
  } catch (const nlohmann::json::exception& error) {
    throw InputError(file + ": the history is damaged: " + error.what());
  }
}

}  // namespace flbc::app
