// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Options of a solve as keyword arguments, and its report as a dict.
#pragma once

#include <string>
#include <vector>

#include "arrays.h"
#include "flbc/options.h"
#include "flbc/report.h"

namespace flbc::python {

//! The names of all options.
std::vector<std::string> option_names();

//! \throws OptionError naming the option
SolverOptions options_of(const py::dict& keywords);

//! All options by their names.
py::dict as_dict(const SolverOptions& options);

//! With the names of the report of `flbc solve`.
py::dict as_dict(const SolveReport& report);

//! A value of an enumeration by its name. \throws OptionError with all names
template <class Enum>
Enum named(const std::string& option, const std::string& name);

}  // namespace flbc::python
