// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Options and status in words, as the command line and the reports have them.
#pragma once

#include "flbc/options.h"
#include "flbc/report.h"

namespace flbc {

//! "value", "gradient", "paper", "lbc2014", "harmonic", "meanvalue" or "auto".
const char* name_of(Method method);
//! "constraint", "project", "off" or "auto".
const char* name_of(NonNegative non_negative);
//! "square", "linear", "sqrt" or "constant".
const char* name_of(DistanceScheme scheme);
//! "breadth-first", "least-squares" or "auto".
const char* name_of(Recovery recovery);
//! "converged", "iteration limit" or "stopped".
const char* name_of(SolveStatus status);

}  // namespace flbc
