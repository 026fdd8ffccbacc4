// SPDX-License-Identifier: BSD-3-Clause
// How an iteration came nearer to its end.
#pragma once

#include <chrono>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "flbc/observer.h"
#include "flbc/report.h"

namespace flbc::app {

//! An evaluation of the residuals. NaN where a method does not know a quantity.
struct HistoryEntry {
  int iteration = 0;     //!< so far, on both meshes
  int finer_levels = 0;  //!< meshes still to come
  double seconds = 0;    //!< since the start, set-up included
  double estimated_error = 0;
  double relative_primal_residual = 0;  //!< divided by its threshold
  double relative_dual_residual = 0;    //!< divided by its threshold
  double objective = 0;                 //!< on the finest mesh
};

//! Records what a progress callback receives. The time that the objective takes does not count.
class HistoryRecorder {
 public:
  //! Starts the clock. \param options  of the solve
  explicit HistoryRecorder(const SolverOptions& options);

  void note(const Progress& progress);

  //! All entries and the end, which no callback receives; none for methods that do not iterate.
  std::vector<HistoryEntry> finished(const SolveReport& report);

 private:
  double seconds_until(std::chrono::steady_clock::time_point now) const;

  std::chrono::steady_clock::time_point start_;
  double tolerance_ = 0;  // of the estimated error; 0 for methods without an estimate
  std::vector<HistoryEntry> entries_;
};

//! A list of numbers for each quantity; null where there is none.
nlohmann::ordered_json history_json(const std::vector<HistoryEntry>& history);

}  // namespace flbc::app
