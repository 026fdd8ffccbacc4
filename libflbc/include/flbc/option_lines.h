// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Options as text, to tell whether two runs are the same.
#pragma once

#include <string>

#include "flbc/options.h"

namespace flbc {

//! A line "name value" for every option that decides which weights an iteration comes to, numbers
//! with all their bits. Left out are the number of threads, by which no bit of a result changes,
//! max_iterations, resume_from and the callbacks.
//! \param options  as resolve() returns them
std::string option_lines(const SolverOptions& options);

}  // namespace flbc
