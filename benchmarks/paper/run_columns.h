// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Columns that several tables have in common.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "flbc/report.h"
#include "paper/csv.h"
#include "paper/setting.h"

namespace flbc::bench {

//! model .. cells, for mesh_row().
inline std::vector<std::string> mesh_columns() {
  return {"model", "control_points", "vertices", "cells"};
}

template <int Dim>
Row mesh_row(const Setting<Dim>& setting) {
  return {{"model", setting.model.name},
          {"control_points", std::to_string(setting.problem.num_control_points())},
          {"vertices", std::to_string(setting.problem.mesh.num_vertices())},
          {"cells", std::to_string(setting.problem.mesh.num_cells())}};
}

//! Set-up, solve, and recovery.
inline double seconds_of(const SolveReport& report) {
  return report.seconds.setup + report.seconds.solve + report.seconds.recover;
}

//! method .. total_seconds, for add_run(). total_seconds adds up set-up, solve and recovery.
inline std::vector<std::string> run_columns() {
  return {"method",        "converged",       "iterations",   "setup_seconds",
          "solve_seconds", "recover_seconds", "total_seconds"};
}

inline void add_run(Row& row, const std::string& method, double setup_seconds,
                    const SolveReport& report) {
  const auto& seconds = report.seconds;
  row["method"] = method;
  row["converged"] = report.status == SolveStatus::kConverged ? "1" : "0";
  row["iterations"] = std::to_string(report.iterations);
  row["setup_seconds"] = number(setup_seconds);
  row["solve_seconds"] = number(seconds.solve);
  row["recover_seconds"] = number(seconds.recover);
  row["total_seconds"] = number(setup_seconds + seconds.solve + seconds.recover);
}

//! Column names one after another.
inline std::vector<std::string> joined(std::initializer_list<std::vector<std::string>> parts) {
  std::vector<std::string> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace flbc::bench
