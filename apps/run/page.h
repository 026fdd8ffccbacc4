// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The page of flbc run.
#pragma once

#include "run/steps.h"
#include "view/page.h"

namespace flbc::app {

//! The cage with the edges and the text of its file, if it was read from one.
template <int Dim>
view::ShownCage<Dim> shown_cage(const Run<Dim>& run);

//! model.html: a page in which the cage can be moved, with the sparse weights and the poses.
template <int Dim>
void write_page(Run<Dim>& run);

}  // namespace flbc::app
