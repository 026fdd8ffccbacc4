// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Names of options and statuses, as used on the command line and in reports.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flbc/cage.h"
#include "flbc/options.h"
#include "flbc/placement.h"
#include "flbc/pointwise.h"
#include "flbc/report.h"

namespace flbc {

//! The name of a value, such as "weights" or "lbc2014".
//! \tparam Enum  Method, Coordinates, NonNegative, DistanceScheme, Distances, Precision, ActiveSet,
//! SolveStatus, Criterion, DefectKind, or OutsidePoints
template <class Enum>
const char* name_of(Enum value);

//! All names of an enumeration, default first.
//! \tparam Enum  as for name_of()
template <class Enum>
std::vector<std::string> names_of();

//! The value with a name; inverse of name_of().
//! \tparam Enum  as for name_of()
//! \param name  as returned by name_of()
//! \return no value if the name is unknown
template <class Enum>
std::optional<Enum> value_named(const std::string& name);

}  // namespace flbc
