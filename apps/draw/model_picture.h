// SPDX-License-Identifier: BSD-3-Clause
// Pictures of a model in space and its cage, as the bytes of a file.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "draw/model_painter.h"
#include "draw/picture_options.h"

namespace flbc::draw {

struct ModelPanel {
  std::string label;
  std::shared_ptr<const ModelPlace> place;
  Eigen::VectorXd values{};                    //!< P, weights; empty: a plain surface
  Index control_point = -1;                    //!< whose weights they are
  std::shared_ptr<const ModelPlace> before{};  //!< shown as a pale copy behind it; null for none
};

//! Draws panels in rows, in the same scale and frame, with a label above each and, next to a single
//! one with weights, the scale of their colors.
//! \throws OptionError if an option is outside its range; InputError if there is no extent
std::string draw_panels(const DrawnModel& model, const std::vector<ModelPanel>& panels,
                        const ObliqueView& view, const WeightPictureOptions& options = {});

//! Draws a model colored by the weights of a control point.
std::string draw_weights(const DrawnModel& model, const ModelPlace& place,
                         const Eigen::VectorXd& values, Index control_point,
                         const ObliqueView& view, const WeightPictureOptions& options = {});

//! Draws a model at rest and in a pose.
std::string draw_poses(const DrawnModel& model, const ModelPlace& rest, const ModelPlace& pose,
                       const ObliqueView& view, const WeightPictureOptions& options = {});

}  // namespace flbc::draw
