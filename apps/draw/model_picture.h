// SPDX-License-Identifier: BSD-3-Clause
// Pictures of a model in space and its cage, as the bytes of a file.
#pragma once

#include <string>
#include <vector>

#include "draw/model_painter.h"
#include "draw/picture_options.h"

namespace flbc::draw {

struct ShownValues {
  Eigen::VectorXd values{};  //!< P, weights of a control point or lengths; empty: a plain surface
  Index control_point = -1;  //!< whose weights they are, -1 for lengths
};

//! Draws the model in one or several places, side by side or, if they are wide, one above the
//! other, in the same scale and the same frame, all but the first with a pale copy of the first.
//! \param places  at least one: at rest, and poses
//! \throws InputError if sizes and indices do not belong together or a number is not finite,
//! OptionError as draw_weights()
std::string draw_model(const DrawnModel& model, const std::vector<ModelPlace>& places,
                       const ShownValues& shown, const ObliqueView& view,
                       const WeightPictureOptions& options = {});

//! Draws a sheet of the model colored by one coordinate function after the other.
//! \param weights  n x P \throws as draw_model()
std::string draw_model_sheet(const DrawnModel& model, const ModelPlace& place,
                             const WeightMatrix& weights, const ObliqueView& view,
                             const WeightPictureOptions& options = {});

struct ModelPanel {
  std::string label;
  ModelPlace place;
  Eigen::VectorXd values;  //!< P, weights; empty: a plain surface
};

//! Draws panels in rows, in the same scale and frame, with a label above each.
//! \param control_point  of the values \throws as draw_model()
std::string draw_panels(const DrawnModel& model, const std::vector<ModelPanel>& panels,
                        Index control_point, const ObliqueView& view,
                        const WeightPictureOptions& options = {});

}  // namespace flbc::draw
