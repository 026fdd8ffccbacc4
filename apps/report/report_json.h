// SPDX-License-Identifier: BSD-3-Clause
// The report of a run as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "flbc/report.h"
#include "solve/solve_settings.h"

namespace flbc::app {

//! Facts of a run that the solver does not know.
struct RunContext {
  int dim = 0;
  double mesh_seconds = 0;
  std::string mesher = "none";
  Quality delivered{};  //!< of the rows written: the model's if there is one
};

//! \param settings  as given; what the solver made of its options is written too
nlohmann::ordered_json report_json(const SolveReport& report, const SolveSettings& settings,
                                   const RunContext& context);

//! The same, shorter, of a part of a cage that has several.
//! \param first_control_point  by which the part is known
nlohmann::ordered_json part_json(const SolveReport& report, Index first_control_point);

//! Whether the report has a certificate: asked for, or what ended the iteration.
bool is_certified(const SolveReport& report);

//! What the certificate proves, in words.
std::string describe_proof(const SolveReport& report);

//! "1100 iterations", and by which criterion they ended if it is not the usual one.
std::string describe_iterations(const SolveReport& report, const SolveSettings& settings);

//! Text for a file, with a line break at the end. File names in it need not be UTF-8, which JSON
//! must be: what is not is replaced.
std::string to_text(const nlohmann::ordered_json& json);

}  // namespace flbc::app
