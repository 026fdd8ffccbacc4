// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Options of a solve as keyword arguments, and its report as a dict.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "arrays.h"
#include "flbc/coordinates.h"

namespace flbc::python {

//! The names of all options.
std::vector<std::string> option_names();

//! \throws OptionError naming the option
SolverOptions options_of(const py::dict& keywords);

//! The coordinates that the method names, or none.
std::optional<Coordinates> coordinates_of(const py::dict& keywords);

//! Options of coordinates, which are threads and non_negative. \throws OptionError for others
SolverOptions coordinates_options_of(const py::dict& keywords);

//! All options by their names.
py::dict as_dict(const SolverOptions& options);

//! With the names of the report of `flbc solve`. \param coordinates  that were computed, if any
py::dict as_dict(const SolveReport& report, const std::optional<Coordinates>& coordinates = {});

//! A value of an enumeration by its name. \throws OptionError with all names
template <class Enum>
Enum named(const std::string& option, const std::string& name);

}  // namespace flbc::python
