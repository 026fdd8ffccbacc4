// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Details that a publication leaves open, one at a time otherwise: a table of variants.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "paper/references.h"
#include "paper/result_table.h"
#include "paper/run_columns.h"

namespace flbc::bench {

//! Of each variant: iterations after which it stops, and errors then and at these iterations.
struct OpenDetails {
  static constexpr std::array<int, 3> kMarks = {100, 300, 1000};
  static constexpr int kLast = 2000;

  static std::vector<std::string> columns() {
    std::vector<std::string> all = {"variant", "iterations", "error"};
    for (const int mark : kMarks) all.push_back("error_" + std::to_string(mark));
    return all;
  }
};

//! Iterates until the published thresholds are reached, of the primal residual 1e-7 a component and
//! of the dual one ten times that, and until the last mark.
//! \param row  takes the columns \param check_interval  iterations between looks at the residuals
//! \param iterate  () -> residuals of one more iteration \param error  () -> mean squared error now
template <class Iterate, class Error>
void run_to_thresholds(Row& row, double num_residual_components, int check_interval, int last,
                       const Iterate& iterate, const Error& error) {
  constexpr int kFirstCheck = 10;
  constexpr auto& kMarks = OpenDetails::kMarks;
  const double threshold = 1e-7 * num_residual_components;
  bool stopped = false;
  for (int k = 1; k <= last && !(stopped && k > kMarks.back()); ++k) {
    const auto residuals = iterate();
    const bool within = residuals.primal <= threshold && residuals.dual <= 10 * threshold;
    if (!stopped && k >= kFirstCheck && k % check_interval == 0 && within) {
      stopped = true;
      row["iterations"] = std::to_string(k);
      row["error"] = number(error());
    }
    const bool is_mark = std::find(kMarks.begin(), kMarks.end(), k) != kMarks.end();
    if (is_mark) row["error_" + std::to_string(k)] = number(error());
  }
}

//! Writes OUT/name.csv: every variant on every model at the paper's size.
//! \param variants  with `name` and `in_double`
//! \param measure  (scalar, setting, optimum, variant, last iteration, row): fills the row
template <class Variants, class Measure>
bool run_open_details(const Context& context, const std::string& name,
                      const std::vector<const char*>& models, const Variants& variants,
                      const std::string& about, const Measure& measure) {
  ResultTable table(context, name, joined({mesh_columns(), OpenDetails::columns()}));
  const int last = context.quick ? OpenDetails::kMarks.front() : OpenDetails::kLast;
  for (const char* model_name : models) {
    const auto& chosen = model(model_name);
    const Index vertices = context.size(chosen.dim, chosen.paper_size);
    for (const auto& variant : variants) {
      const auto what = name + ", " + variant.name;
      table.add(in_setting(context, what, chosen, vertices, [&](const auto& setting) {
        const auto optimum = reference(context, setting).weights;
        auto row = mesh_row(setting);
        row["variant"] = variant.name;
        if (variant.in_double) {
          measure(double(), setting, optimum, variant, last, row);
        } else {
          measure(float(), setting, optimum, variant, last, row);
        }
        return table.line(row);
      }));
    }
  }
  return table.write(about +
                     ": iterations after which it stops by the published thresholds, mean squared "
                     "error then and after so many iterations; no iterations: not within " +
                     std::to_string(OpenDetails::kLast) +
                     "; nothing of this depends on the machine");
}

}  // namespace flbc::bench
