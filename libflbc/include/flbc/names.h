// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Options and status in words, as the command line and the reports have them. Each enumeration has
//! one table, read in both directions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flbc/options.h"
#include "flbc/placement.h"
#include "flbc/report.h"

namespace flbc {

//! The name of a value, as the program and its reports write it, such as "value" or "lbc2014".
//! \tparam Enum  Method, NonNegative, DistanceScheme, Distances, Recovery, Precision, ActiveSet,
//! CoarseToFine, LinearSolver, SolveStatus, Criterion, or OutsidePoints
template <class Enum>
const char* name_of(Enum value);

//! All names of an enumeration, the default first.
//! \tparam Enum  one of those that name_of() takes
template <class Enum>
std::vector<std::string> names_of();

//! The value that has a name, the inverse of name_of().
//! \tparam Enum  one of those that name_of() takes
//! \param name  as name_of() gives it
//! \return nothing if no value has this name
template <class Enum>
std::optional<Enum> value_named(const std::string& name);

}  // namespace flbc
