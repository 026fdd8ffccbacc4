// SPDX-License-Identifier: BSD-3-Clause
// Moves files of points of any size, batch by batch.
#pragma once

#include <string>

#include "flbc/evaluator.h"
#include "flbc/io/point_file.h"

namespace flbc::app {

struct PointMotion {
  std::string input;
  io::PointLayout layout{};  //!< of the input
  std::string output;
  OutsidePoints outside = OutsidePoints::kFail;
  bool quiet = false;
};

//! Writes the output in the format of the input. \return the largest displacement
//! \param evaluator  moves points outside to some place, whatever the policy of the motion
//! \throws IoError, InputError; then the output is not written
template <int Dim>
double deform_points(const PointMotion& motion, const Evaluator<Dim>& evaluator,
                     const PointList<Dim>& control_points);

}  // namespace flbc::app
