// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The machine, and the memory of this process.
#pragma once

#include <string>

namespace flbc::bench {

//! Processor, number of its cores, threads used, compiler, library version; one line, no date.
std::string describe_machine(int threads);

//! Number of cores this process may use.
int available_cores();

//! Resident memory now, in MiB, after freed memory went back to the system.
double resident_mebibytes();

//! Largest resident memory in MiB since the process began or the last reset_peak().
double peak_mebibytes();

//! Starts the peak anew. Where the system refuses, the peak stays that of the whole process.
void reset_peak();

}  // namespace flbc::bench
