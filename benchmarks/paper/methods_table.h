// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Tables with a line per model, at the paper's sizes, and method.
#pragma once

#include <string>

#include "paper/methods.h"
#include "paper/references.h"
#include "paper/result_table.h"
#include "paper/run_columns.h"

namespace flbc::bench {

//! Adds the lines measure(setting, method) -> Row. The reference of each model is there before.
//! \param name  of the experiment \param is_wanted  which methods
template <class IsWanted, class Measure>
void add_methods(const Context& context, const std::string& name, ResultTable& table,
                 const IsWanted& is_wanted, const Measure& measure) {
  for (const auto& model : models()) {
    const Index vertices = context.size(model.dim, model.paper_size);
    const auto ready = in_setting(context, name + " reference", model, vertices,
                                  [&](const auto& setting) -> std::string {
                                    reference(context, setting);
                                    return "";
                                  });
    table.add(ready);
    if (!ready) continue;
    for (const auto& method : methods()) {
      if (!is_wanted(method)) continue;
      table.add(
          in_setting(context, name + " " + method.name, model, vertices,
                     [&](const auto& setting) { return table.line(measure(setting, method)); }));
    }
  }
}

}  // namespace flbc::bench
