// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The report of a run as JSON.
#pragma once

#include <string>

#include "flbc/options.h"
#include "flbc/report.h"

namespace flbc::app {

//! What the program did around the solver.
struct RunContext {
  int dim = 0;
  std::string cage;
  std::string domain;  //!< empty if the cage was meshed
  std::string model;   //!< empty without model
  bool embed = false;
  Index wanted_vertices = 0;
  double mesh_seconds = 0;
  std::string coarse_to_fine = "auto";
  Quality delivered{};  //!< of the rows written: the model's if there is one
};

//! \param options  as given; what the solver made of them is written too
std::string report_json(const SolveReport& report, const SolverOptions& options,
                        const RunContext& context);

}  // namespace flbc::app
