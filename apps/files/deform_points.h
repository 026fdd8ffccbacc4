// SPDX-License-Identifier: BSD-3-Clause
// Moves files of points of any size, batch by batch.
#pragma once

#include <cstdint>
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

//! Of the points in a pose.
struct MovedPoints {
  double largest = 0;        //!< displacement
  std::int64_t outside = 0;  //!< number outside the cage
  double farthest = 0;       //!< distance of those
};

//! Writes the output in the format of the input.
//! \param evaluator  moves points outside to some place, whatever the policy of the motion
//! \throws IoError, InputError; then the output is not written
template <int Dim>
MovedPoints deform_points(const PointMotion& motion, const Evaluator<Dim>& evaluator,
                          const PointList<Dim>& control_points);

}  // namespace flbc::app
