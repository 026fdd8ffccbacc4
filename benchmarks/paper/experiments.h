// SPDX-License-Identifier: BSD-3-Clause
// Tables and figures. Each function writes OUT/NAME.csv and returns false if a part of it failed,
// after a message on stderr.
#pragma once

#include "toolkit.h"

namespace flbc::bench {

bool run_table1(const Context& context);   //!< with and without non-negativity
bool run_table2(const Context& context);   //!< methods compared at the paper's sizes
bool run_speed(const Context& context);    //!< time to a tolerance of 1e-5, up to millions of cells
bool run_race(const Context& context);     //!< iterations and time to a true error of 1e-5
bool run_samples(const Context& context);  //!< harmonic and race, on the samples of meshes/
bool run_models(const Context& context);   //!< by default, next to harmonic coordinates

//! What the library computes for some samples of meshes/, in the current folder. Each entry has the
//! iterations and a mean of squared weights: `figure 168/0.41573`. One thread; depends in the last
//! digits on vector width and compiler, and not on the speed of the machine.
std::string behavior();

}  // namespace flbc::bench
