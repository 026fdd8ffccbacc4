// SPDX-License-Identifier: BSD-3-Clause
// Options for the axis of a model that points up, and for where pictures show it from.
#pragma once

#include <vector>

#include <CLI/CLI.hpp>

#include "draw/view.h"
#include "front/up_axis.h"

namespace flbc::app {

//! --up of the commands that show or export models, with the default kAuto.
CLI::Option* add_up_option(CLI::App& command, UpAxis& up);

//! From where a picture shows a model in 3D.
struct ModelView {
  draw::ObliqueView direction = draw::view_by_angles(draw::kUsualAzimuth, draw::kUsualElevation);
  UpAxis up = UpAxis::kAuto;
};

//! --view and --up of the commands that draw models.
std::vector<CLI::Option*> add_view_options(CLI::App& command, ModelView& view);

//! The view of points as they are in their file, 3 x P: azimuths are relative to their front.
draw::ObliqueView view_of(const ModelView& view, const PointList<3>& points);

}  // namespace flbc::app
