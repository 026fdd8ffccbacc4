// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The page of flbc run.
#pragma once

#include "run/steps.h"

namespace flbc::app {

//! model.html: a page in which the cage can be moved, with the sparse weights and the poses.
template <int Dim>
void write_page(Run<Dim>& run);

}  // namespace flbc::app
