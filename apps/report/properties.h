// SPDX-License-Identifier: BSD-3-Clause
// The properties by which kinds of coordinates are compared, as rows of a table.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "flbc/check.h"

namespace flbc::app {

//! Rows of cells, the first with headings.
using TextTable = std::vector<std::vector<std::string>>;

//! The properties of weights by their names in reports. Those that need a mesh are missing without
//! one.
template <int Dim>
nlohmann::ordered_json properties_of(const WeightCheck<Dim>& check);

//! A row for each named set of properties, with a column for each property that a set has.
TextTable property_table(
    const std::vector<std::pair<std::string, nlohmann::ordered_json>>& properties);

//! What each column of a property table means, with its unit: a heading and a text per row.
TextTable property_legend(const TextTable& table);

std::string to_text(const TextTable& table);

}  // namespace flbc::app
