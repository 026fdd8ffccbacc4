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

//! "auto", "value", "gradient", "paper", "lbc2014", "harmonic" or "meanvalue".
//! \param method  to be named
const char* name_of(Method method);
//! "auto", "constraint", "project" or "off".
//! \param non_negative  to be named
const char* name_of(NonNegative non_negative);
//! "square", "linear", "sqrt" or "constant".
//! \param scheme  to be named
const char* name_of(DistanceScheme scheme);
//! "auto", "exact" or "interpolated".
//! \param distances  to be named
const char* name_of(Distances distances);
//! "auto", "breadth-first" or "least-squares".
//! \param recovery  to be named
const char* name_of(Recovery recovery);
//! "auto", "single" or "double".
//! \param precision  to be named
const char* name_of(Precision precision);
//! "auto", "on" or "off".
//! \param choice  to be named
const char* name_of(CoarseToFine choice);
//! "auto", "on" or "off".
//! \param choice  to be named
const char* name_of(ActiveSet choice);
//! "auto", "direct" or "multigrid".
//! \param solver  to be named
const char* name_of(LinearSolver solver);
//! "converged", "iteration limit" or "stopped".
//! \param status  to be named
const char* name_of(SolveStatus status);
//! "none", "tolerance" or "gap".
//! \param criterion  to be named
const char* name_of(Criterion criterion);
//! "fail", "nearest" or "extend".
//! \param policy  to be named
const char* name_of(OutsidePoints policy);

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
