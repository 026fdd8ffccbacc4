// SPDX-License-Identifier: BSD-3-Clause
// Options for the axis of a model that points up, and for where pictures show it from.
#pragma once

#include <CLI/CLI.hpp>

#include "draw/view.h"
#include "front/up_axis.h"

namespace flbc::app {

//! --up of the commands that show or export models, with the default kAuto.
CLI::Option* add_up_option(CLI::App& command, UpAxis& up);

//! The view of points as they are in their file, 3 x P: from the front, the right, and above.
draw::ObliqueView view_of(UpAxis up, const PointList<3>& points);

}  // namespace flbc::app
