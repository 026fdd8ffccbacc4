// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Options of a solve or a Rig as keyword arguments, and its report as a dict.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arrays.h"
#include "flbc/binding.h"

namespace flbc::python {

//! Masks are those of the solver. \param keywords  others are ignored
//! \throws OptionError naming the option, also if other coordinates do not use it
BindOptions options_of(const py::dict& keywords);

//! With the names of the report of `flbc solve`. \param method  name; empty for that in the report
py::dict as_dict(const SolveReport& report, const std::string& method = "");
py::dict as_dict(const BindReport& report);

//! The arrays of a proof, a row per cell or vertex; None without one.
py::object as_python(const std::shared_ptr<const Proof>& proof);

//! A value of an enumeration by its name. \throws OptionError with all names
template <class Enum>
Enum named(const std::string& option, const std::string& name);

}  // namespace flbc::python
